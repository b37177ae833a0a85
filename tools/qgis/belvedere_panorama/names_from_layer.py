"""Names from a layer: its names as [[labels.points]] or [[labels.shapes]] of a scene."""
import os
import tempfile

from qgis.core import (
    NULL,
    QgsCoordinateTransformContext,
    QgsFeature,
    QgsFields,
    QgsGeometry,
    QgsProcessingException,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterString,
    QgsVectorFileWriter,
)

from . import compat, layers, program, scene_file
from .algorithm import Algorithm


class NamesFromLayer(Algorithm):
    """A scene with the names of a layer, placed by the program."""

    NAME = "namesfromlayer"
    TITLE = "Names from a layer"
    HELP = (
        "Adds names to a scene: those of points stand at their marks, those of lines and areas "
        "follow them. The names are written to a file beside the scene, and <i>Render panorama</i> "
        "then also writes a picture with them.\n"
        "Kinds are words of the style: summit, town, village, hut, pass, lake, river, glacier, "
        "valley, range … Ranks are 1 (most important) to 9. The log says how many names find a "
        "place."
    )

    def initAlgorithm(self, _configuration=None) -> None:
        self.add_scene()
        self.addParameter(QgsProcessingParameterFeatureSource("LAYER", "Layer"))
        for name, text, needed in (
            ("NAME", "Field with the names", True),
            ("RANK", "Field with the ranks, 1 to 9", False),
            ("KIND", "Field with the kinds", False),
        ):
            default = "name" if needed else None
            self.addParameter(
                QgsProcessingParameterField(name, text, default, "LAYER", optional=not needed)
            )
        self.addParameter(
            QgsProcessingParameterString("ALL", "Kind of all others", "", optional=True)
        )
        self.addParameter(
            QgsProcessingParameterFileDestination("OUTPUT", "Scene with them", "Scene (*.toml)")
        )

    def prepareAlgorithm(self, parameters, context, _feedback) -> bool:
        self.out = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        source = self.parameterAsSource(parameters, "LAYER", context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, "LAYER"))
        if not source.sourceCrs().isValid():
            raise QgsProcessingException(
                f'The layer "{source.sourceName()}" has no coordinate system. Set it in the '
                "layer's properties, under Source."
            )
        self.file = layers.name_beside(source.sourceName(), self.out, "_names.gpkg")
        self._write(source, parameters, context)
        return True

    def _write(self, source, parameters, context) -> None:
        """A file with the columns that the program reads. Each part of a geometry has the name."""
        column = {
            name: source.fields().lookupField(self.parameterAsString(parameters, name, context))
            for name in ("NAME", "RANK", "KIND")
        }
        others = self.parameterAsString(parameters, "ALL", context)
        fields = QgsFields()
        for name, kind in (("name", "text"), ("kind", "text"), ("rank", "integer")):
            fields.append(compat.field(name, kind))
        self.points = compat.is_point(source.wkbType())
        options = QgsVectorFileWriter.SaveVectorOptions()
        options.driverName = "GPKG"
        writer = QgsVectorFileWriter.create(
            self.file, fields, compat.WKB_ANY, source.sourceCrs(), QgsCoordinateTransformContext(),
            options,
        )
        if writer.hasError() != compat.WRITTEN:
            raise QgsProcessingException(f"{self.file}: {writer.errorMessage()}")
        self.count = 0
        for feature in source.getFeatures():
            values = {
                name: feature[i] for name, i in column.items() if i >= 0 and feature[i] != NULL
            }
            name = str(values.get("NAME", "")).strip()
            if not name or not feature.hasGeometry():
                continue
            kind = str(values.get("KIND", "")) or others
            rank = int(values["RANK"]) if "RANK" in values else None
            for part in feature.geometry().asGeometryCollection():
                out = QgsFeature(fields)
                out.setGeometry(QgsGeometry(part))
                out.setAttributes([name, kind or None, rank])
                writer.addFeature(out, compat.FAST_INSERT)
                self.count += 1
        del writer  # completes the file
        if self.count == 0:
            raise QgsProcessingException(f'No feature of "{source.sourceName()}" has a name.')

    def processAlgorithm(self, parameters, context, feedback):
        scene = self.scene_path(parameters, context)
        table = "[[labels.points]]" if self.points else "[[labels.shapes]]"
        text = scene_file.block(table, {"file": os.path.basename(self.file)})
        if "[labels]" not in scene_file.read(scene):
            text = scene_file.block("[labels]", {"in_picture": True}) + text
        scene_file.extended(scene, self.out, text, self.data_folders(parameters, context))
        words = ["labels", self.out]
        for folder in scene_file.data_folders(self.out):
            words += ["--data", folder]
        with tempfile.TemporaryDirectory() as folder:
            answer = program.ask([*words, "--out", folder], feedback)
        counts = [f"{answer[name]} {name.replace('_', ' ')}" for name in answer
                  if isinstance(answer[name], (int, float)) and name not in ("points", "placed")
                  and answer[name]]
        placed = f"{answer['placed']} of {answer['points']} names placed"
        feedback.pushInfo(", ".join([placed, *counts]))
        return {"OUTPUT": self.out, "NAMES": self.file}
