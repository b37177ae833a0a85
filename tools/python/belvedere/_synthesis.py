"""Guided texture synthesis."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping, Sequence, Union

from belvedere import _belvedere
from belvedere._error import Error
from belvedere._progress import Progress, run

if TYPE_CHECKING:
    import numpy as np

    Arrays = Union["np.ndarray", Sequence["np.ndarray"]]


def _each(given: Any, pictures: int, name: str) -> list:
    listed = given if isinstance(given, list) else [given]
    if len(listed) != pictures:
        raise Error(name, f"{len(listed)} arrays", f"{pictures}, as many as pictures")
    return listed


def synthesize(
    picture: Arrays, labels: Arrays, target_labels: np.ndarray, *, guides: Mapping[str, tuple[Arrays, np.ndarray, float]] = {},
    fallback: Mapping[int, int] = {}, seed: int = 1, levels: int = 6, reuse: float = 1.0, copy_cap: int = 240, neighbourhood: int = 7,
    surroundings: float = 1.0, surroundings_of: str = "commonest", threads: int = 0, progress: Progress = "auto"
) -> tuple[np.ndarray, np.ndarray]:
    """Copies the texture of a painting to where labels and guides say (docs/synthesis.md).

    picture: uint8 (height, width, 3), encoded sRGB. labels: uint8 (height, width), a number per class; 255
    is never copied. target_labels: the same of the result. guides: name to source, target and weight:
    uint8 of the sizes of picture and target, 0…100. Lists of pictures, labels and sources for several
    paintings. Arrays of that type in C order are not copied. fallback: label to the label that is copied
    where no picture has it, 0…254. levels: 1…8. reuse: price of repetition, 0…10. copy_cap: of a copied
    piece, px, 16…100000. neighbourhood: side of compared patches, px: 3, 5, 7, 9 or 11. surroundings: weight
    of the classes around, 0…100; surroundings_of: "commonest" or "all" of them.

    Returns the picture, uint8 (height, width, 3), and the match field, uint16 (height, width, 3): number of
    the picture (65535: nothing could be copied, black), and x and y in it, px.
    """
    options = dict(locals())
    from belvedere._arrays import numbers
    from belvedere._arrays import picture as taken_picture

    pictures = picture if isinstance(picture, list) else [picture]
    count = len(pictures)
    sources: list[list[tuple[str, np.ndarray]]] = [[] for _ in pictures]
    targets: list[tuple[str, np.ndarray]] = []
    options.update({"weights": [], "fallback": dict(fallback)})
    for name, guide in guides.items():
        where = f'guides["{name}"]'
        if not isinstance(guide, (tuple, list)) or len(guide) != 3:
            raise Error(where, "is no guide", "(source, target, weight)")
        for own, source in zip(sources, _each(guide[0], count, where)):
            own.append((name, numbers(source, f"{where} source")))
        targets.append((name, numbers(guide[1], f"{where} target")))
        options["weights"].append((name, float(guide[2])))
    for pair in fallback.items():
        if not all(0 <= label < 255 for label in pair) or pair[0] == pair[1]:
            raise Error("fallback", f"{pair[0]}: {pair[1]}", "two different labels, 0 … 254")
    exemplars = [
        (taken_picture(one, "picture"), numbers(own, "labels"), stack)
        for one, own, stack in zip(pictures, _each(labels, count, "labels"), sources)
    ]
    target = numbers(target_labels, "target_labels")
    return _belvedere.synthesize(exemplars, target, targets, options, run(progress, threads))
