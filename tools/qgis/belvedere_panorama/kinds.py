"""Which kinds of features a layer holds, by its columns, OpenStreetMap tags and name."""
import re
from typing import Dict, Iterable, List, NamedTuple, Optional


def _table(text: str) -> Dict[str, List[str]]:
    rows = (row.split(":") for row in text.split(";"))
    return {kind.strip(): also.split() for kind, also in rows}


# The kinds of data/features/classic.toml, and what else files call them.
LINES = _table("""motorway: motorway_link trunk trunk_link autobahn; main_road: primary primary_link
secondary secondary_link road_1 bundesstrasse; road: tertiary tertiary_link unclassified residential
living_street street strasse; track: service farm_track forest_road forstweg fahrweg; path: footway
footpath trail steps bridleway hiking weg steig pfad; route: tour gpx relation; railway: rail train
light_rail bahn; narrow_gauge: funicular rack tram zahnradbahn standseilbahn; lift: cable_car
gondola chair_lift mixed_lift drag_lift t-bar j-bar platter aerialway seilbahn sessellift; run_easy:
novice easy blue blau; run_intermediate: intermediate red rot; run_difficult: advanced expert
difficult black schwarz; river: fluss canal; stream: brook bach ditch; coastline: coast kueste""")
AREAS = _table("""building: house yes hut alpine_hut farm barn gebaeude; lake: water reservoir pond
see; river_area: riverbank river_bed; sea: ocean bay; glacier: ferner kees gletscher; forest: wood
wald; scrub: shrub heath krummholz; meadow: grass grassland pasture wiese weide; fields: farmland
vineyard orchard acker weinberg; rock: bare_rock cliff fels; scree: shingle geroell; sand: beach
dune; snow: firn neve; town: city village hamlet residential_area settlement ort stadt dorf""")
POINTS = ("building", "town")

TAGS = ("highway", "railway", "aerialway", "waterway", "piste:difficulty", "natural", "landuse",
        "water", "building", "place")
COLUMNS = ("kind", "type", "class", "fclass", "category", "art")  # of other sources
# Values of tags that mean something else than the same word of the style.
MEANT = {("landuse", "residential"): "town", ("water", "river"): "river_area",
         ("waterway", "riverbank"): "river_area"}


class Kinds(NamedTuple):
    """A part of a layer: its kind, or the column that holds it, and the SQL that selects it."""

    kind: str
    column: str
    where: str


def words_of(shape: str) -> Dict[str, str]:
    """All words for kinds of a shape ("line", "area" or "point"), and the kind of each."""
    kinds = dict(LINES if shape == "line" else AREAS)
    if shape == "point":
        kinds = {kind: AREAS[kind] for kind in POINTS}
    return {word: kind for kind, also in kinds.items() for word in [kind, *also]}


def _text(value: str) -> str:
    return "'" + value.replace("'", "''") + "'"


def of_column(column: str, values: Iterable[str], shape: str) -> List[Kinds]:
    """What a column with these values tells: a part for the words of the style, and one for each
    kind that its tag means otherwise."""
    words, parts = words_of(shape), {}
    for value in sorted(values):
        kind = MEANT.get((column, value), "")
        if (kind or value) in words:
            parts.setdefault(kind, []).append(_text(value))
    quoted = '"' + column.replace('"', '""') + '"'
    return [Kinds(kind, "" if kind else column, f"{quoted} IN ({', '.join(chosen)})")
            for kind, chosen in parts.items()]


def of_tags(texts: Iterable[str], shape: str) -> List[Kinds]:
    """The same for GDAL's column other_tags with these texts: a part for each kind."""
    words, parts = words_of(shape), {}
    tags = {tag for text in texts for tag in re.findall(r'"([^"]+)"=>"([^"]*)"', text)}
    for key, value in sorted(tags):
        kind = MEANT.get((key, value)) or words.get(value)
        if key in TAGS and kind in words:
            pattern = _text(f'%"{key}"=>"{value}"%')
            parts.setdefault(kind, []).append(f'"other_tags" LIKE {pattern}')
    return [Kinds(kind, "", " OR ".join(sql)) for kind, sql in parts.items()]


def of_name(name: str, shape: str) -> Optional[str]:
    """The kind that the name of a layer tells, such as "Rivers of Tyrol"."""
    words = words_of(shape)
    found = re.findall(r"[a-zäöüß_-]+", name.lower().replace("yes", ""))
    forms = (form for word in found for form in (word, re.sub("[sne]$", "", word)))
    return next((words[form] for form in forms if form in words), None)
