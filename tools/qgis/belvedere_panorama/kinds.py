"""Which kinds of features a layer holds, by its columns, OpenStreetMap tags and name."""
import re
from typing import Dict, Iterable, List, NamedTuple, Optional

# The words of data/features/classic.toml: each kind, and what else files call it.
LINES: Dict[str, str] = {
    "motorway": "motorway_link trunk trunk_link autobahn",
    "main_road": "primary primary_link secondary secondary_link road_1 bundesstrasse",
    "road": "tertiary tertiary_link unclassified residential living_street street strasse",
    "track": "service farm_track forest_road forstweg fahrweg",
    "path": "footway footpath trail steps bridleway hiking weg steig pfad",
    "route": "tour gpx relation",
    "railway": "rail train light_rail bahn",
    "narrow_gauge": "funicular rack tram zahnradbahn standseilbahn",
    "lift": "cable_car gondola chair_lift mixed_lift drag_lift t-bar j-bar platter aerialway "
            "seilbahn sessellift",
    "run_easy": "novice easy blue blau",
    "run_intermediate": "intermediate red rot",
    "run_difficult": "advanced expert difficult black schwarz",
    "river": "fluss canal",
    "stream": "brook bach ditch",
    "coastline": "coast kueste",
}
AREAS: Dict[str, str] = {
    "building": "house yes hut alpine_hut farm barn gebaeude",
    "lake": "water reservoir pond see",
    "river_area": "riverbank river_bed",
    "sea": "ocean bay",
    "glacier": "ferner kees gletscher",
    "forest": "wood wald",
    "scrub": "shrub heath krummholz",
    "meadow": "grass grassland pasture wiese weide",
    "fields": "farmland vineyard orchard acker weinberg",
    "rock": "bare_rock cliff fels",
    "scree": "shingle geroell",
    "sand": "beach dune",
    "snow": "firn neve",
    "town": "city village hamlet residential_area settlement ort stadt dorf",
}
RUNS = ("run_easy", "run_intermediate", "run_difficult")  # of areas, too
POINTS = ("building", "town")

TAGS = ("highway", "railway", "aerialway", "waterway", "piste:difficulty", "natural", "landuse",
        "water", "building", "place")
COLUMNS = ("kind", "type", "class", "fclass", "category", "art")  # of other sources
# Values of tags that the style knows as something else: residential is a road in highway alone.
MEANT = {("landuse", "residential"): "town", ("landuse", "meadow"): "meadow",
         ("water", "river"): "river_area", ("waterway", "riverbank"): "river_area"}


class Kinds(NamedTuple):
    """A part of a layer: its kind, or the column that holds it, and the SQL that selects it."""

    kind: str
    column: str
    where: str


def words_of(shape: str) -> Dict[str, str]:
    """All words for kinds of a shape ("line", "area" or "point"), and the kind of each."""
    known = {"line": LINES, "area": AREAS, "point": AREAS}[shape]
    rows = [(kind, also) for kind, also in known.items() if shape != "point" or kind in POINTS]
    rows += [(kind, LINES[kind]) for kind in RUNS] if shape == "area" else []
    return {word: kind for kind, also in rows for word in [kind, *also.split()]}


def _text(value: str) -> str:
    return "'" + value.replace("'", "''") + "'"


def of_column(column: str, values: Iterable[str], shape: str) -> List[Kinds]:
    """What a column with these values tells: a part for the words of the style, and one for each
    kind that its tag means otherwise."""
    words, quoted = words_of(shape), '"' + column.replace('"', '""') + '"'
    meant: Dict[str, List[str]] = {}
    plain = []
    for value in sorted(values):
        kind = MEANT.get((column, value))
        if kind and kind in words:
            meant.setdefault(kind, []).append(value)
        elif value in words and not kind:
            plain.append(value)

    def among(chosen: List[str]) -> str:
        return f"{quoted} IN ({', '.join(_text(value) for value in chosen)})"

    out = [Kinds("", column, among(plain))] if plain else []
    return out + [Kinds(kind, "", among(chosen)) for kind, chosen in meant.items()]


def of_tags(tags: Dict[str, Iterable[str]], shape: str) -> List[Kinds]:
    """The same for tags in GDAL's column other_tags: a part for each kind."""
    words = words_of(shape)
    found: Dict[str, List[str]] = {}
    for key in TAGS:
        for value in sorted(tags.get(key, ())):
            kind = MEANT.get((key, value)) or words.get(value)
            if kind in words:
                pattern = f'%"{key}"=>"{value}"%'
                found.setdefault(kind, []).append(f'"other_tags" LIKE {_text(pattern)}')
    return [Kinds(kind, "", " OR ".join(sql)) for kind, sql in found.items()]


def of_name(name: str, shape: str) -> Optional[str]:
    """The kind that the name of a layer tells, such as "Rivers of Tyrol"."""
    words = words_of(shape)
    for word in re.findall(r"[a-zäöüß_-]+", name.lower()):
        for form in (word, word[:-1] if word.endswith("s") else word, word[:-2]):
            if form in words and form != "yes":
                return words[form]
    return None


def tags_of(texts: Iterable[str]) -> Dict[str, set]:
    """Keys and values of the tags in texts of other_tags."""
    out: Dict[str, set] = {}
    for text in texts:
        for key, value in re.findall(r'"([^"]+)"=>"([^"]*)"', text):
            if key in TAGS:
                out.setdefault(key, set()).add(value)
    return out
