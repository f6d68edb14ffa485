#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Draw a VTU file of a run as a PNG picture.

Points are drawn as squares (cubes in 3D) of the size of their volume, meshes
as cells with their edges. Needs the Debian packages python3-vtk9 and xvfb
(without a display the program starts itself under xvfb-run).

    render.py results/points/00020.vtu --field stress --component xy \\
              --range -5 5 --title "shear stress" --unit MPa -o shear.png
"""

import argparse
import os
import shutil
import sys

if not os.environ.get("DISPLAY") and shutil.which("xvfb-run"):
    os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable] + sys.argv)

import vtk  # noqa: E402  (must come after the display is there)

TENSOR = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"]
VECTOR = ["x", "y", "z"]


def read(path):
    """The data set of a VTU file."""
    if not os.path.isfile(path):
        sys.exit(f"render.py: there is no file {path}")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def component_index(array, component):
    """Column of the array that a component name means; -1: magnitude."""
    n = array.GetNumberOfComponents()
    names = {1: [""], 3: VECTOR, 9: TENSOR}.get(n, [str(i) for i in range(n)])
    if n == 1 and component in ("", "magnitude"):
        return 0
    if component in ("", "magnitude"):
        return -1
    if component not in names:
        sys.exit(f"render.py: {array.GetName()} has no component '{component}'; "
                 f"there are {', '.join(names)}, magnitude")
    return names.index(component)


def add_value(data, field, component):
    """Add the numbers to draw as the point array 'value'; return their range."""
    fields = data.GetPointData()
    array = fields.GetArray(field)
    if array is None:
        names = [fields.GetArrayName(i)
                 for i in range(fields.GetNumberOfArrays())]
        sys.exit(f"render.py: no field '{field}'; there are {', '.join(names)}")
    column = component_index(array, component)
    value = vtk.vtkDoubleArray()
    value.SetName("value")
    value.SetNumberOfTuples(array.GetNumberOfTuples())
    for i in range(array.GetNumberOfTuples()):
        row = array.GetTuple(i)
        value.SetValue(i, row[column] if column >= 0 else
                       sum(x * x for x in row) ** 0.5)
    fields.AddArray(value)
    return value.GetRange()


def is_flat(data):
    bounds = data.GetBounds()
    return bounds[5] - bounds[4] == 0.0


def as_boxes(data):
    """A square or cube of its volume for every point."""
    fields = data.GetPointData()
    volume = fields.GetArray("volume")
    edge = vtk.vtkDoubleArray()
    edge.SetName("edge")
    edge.SetNumberOfTuples(data.GetNumberOfPoints())
    exponent = 1.0 / 2.0 if is_flat(data) else 1.0 / 3.0
    for i in range(data.GetNumberOfPoints()):
        edge.SetValue(i, volume.GetValue(i) ** exponent)
    fields.AddArray(edge)
    fields.SetActiveScalars("edge")

    shape = vtk.vtkPlaneSource() if is_flat(data) else vtk.vtkCubeSource()
    glyphs = vtk.vtkGlyph3D()
    glyphs.SetInputData(data)
    glyphs.SetSourceConnection(shape.GetOutputPort())
    glyphs.SetScaleModeToScaleByScalar()
    glyphs.SetColorModeToColorByScalar()
    glyphs.OrientOff()
    glyphs.Update()
    return glyphs.GetOutput()


def colours():
    """Blue over white to red, even steps for the eye."""
    function = vtk.vtkColorTransferFunction()
    function.SetColorSpaceToDiverging()
    function.AddRGBPoint(0.0, 0.230, 0.299, 0.754)
    function.AddRGBPoint(1.0, 0.706, 0.016, 0.150)
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i in range(256):
        table.SetTableValue(i, *function.GetColor(i / 255.0), 1.0)
    table.Build()
    return table


def text_style(text, size):
    text.SetFontSize(size)
    text.SetColor(0, 0, 0)
    text.SetFontFamilyToArial()
    text.BoldOff()
    text.ItalicOff()
    text.ShadowOff()


def colour_bar(table, size):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.4g")
    bar.UnconstrainedFontSizeOn()
    text_style(bar.GetLabelTextProperty(), size)
    bar.SetPosition(0.84, 0.12)
    bar.SetWidth(0.12)
    bar.SetHeight(0.72)
    bar.SetBarRatio(0.25)
    return bar


def title_above_bar(title, size):
    """A text of its own: the bar would cut off what is wider than itself."""
    text = vtk.vtkTextActor()
    text.SetInput(title)
    text_style(text.GetTextProperty(), size)
    text.GetTextProperty().SetJustificationToRight()
    text.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    text.SetPosition(0.97, 0.9)
    return text


def axes(data, renderer, unit, size):
    actor = vtk.vtkCubeAxesActor()
    actor.SetBounds(data.GetBounds())
    actor.SetCamera(renderer.GetActiveCamera())
    for name, direction in zip("XYZ", range(3)):
        getattr(actor, f"Set{name}Title")(name.lower())
        getattr(actor, f"Set{name}Units")(unit)
        text_style(actor.GetTitleTextProperty(direction), size)
        text_style(actor.GetLabelTextProperty(direction), size)
        getattr(actor, f"Get{name}AxesLinesProperty")().SetColor(0, 0, 0)
    actor.SetFlyModeToOuterEdges()
    actor.SetScreenSize(size)
    if is_flat(data):
        actor.SetUse2DMode(1)
        actor.ZAxisVisibilityOff()
    return actor


def look_at(renderer, data, aspect):
    """Whole picture with room for the axes and, at the right, the bar."""
    camera = renderer.GetActiveCamera()
    bounds = data.GetBounds()
    centre = [(bounds[2 * d] + bounds[2 * d + 1]) / 2 for d in range(3)]
    size = [bounds[2 * d + 1] - bounds[2 * d] for d in range(3)]
    camera.ParallelProjectionOn()
    if is_flat(data):
        height = max(size[1] * 1.3, size[0] / aspect * 1.6)
        centre[0] += 0.1 * height * aspect
        camera.SetPosition(centre[0], centre[1], 1)
        camera.SetViewUp(0, 1, 0)
    else:
        diagonal = sum(x * x for x in size) ** 0.5
        height = 1.1 * diagonal
        centre[0] += 0.08 * diagonal
        centre[1] += 0.05 * diagonal
        camera.SetPosition(centre[0] + diagonal, centre[1] - 1.6 * diagonal,
                           centre[2] + diagonal)
        camera.SetViewUp(0, 0, 1)
    camera.SetFocalPoint(centre)
    camera.SetParallelScale(height / 2)
    renderer.ResetCameraClippingRange()


def arguments():
    parser = argparse.ArgumentParser(
        description="Draw a VTU file of a run as a PNG picture.")
    parser.add_argument("file", help="VTU file of points or of a mesh")
    parser.add_argument("--mesh", help="VTU file whose cell edges are drawn too")
    parser.add_argument("--field", default="displacement")
    parser.add_argument("--component", default="",
                        help="x, y, z; xx, xy, ...; magnitude")
    parser.add_argument("--range", nargs=2, type=float,
                        help="values at the ends of the colour bar")
    parser.add_argument("--title", help="title of the colour bar")
    parser.add_argument("--unit", default="", help="unit in that title")
    parser.add_argument("--length-unit", default="", help="unit of the axes")
    parser.add_argument("--size", nargs=2, type=int, default=[1000, 700])
    parser.add_argument("-o", "--output", required=True, help="PNG file")
    return parser.parse_args()


def main():
    args = arguments()
    data = read(args.file)
    found_range = add_value(data, args.field, args.component)
    value_range = args.range or found_range
    is_points = data.GetPointData().HasArray("volume")
    shapes = as_boxes(data) if is_points else data

    table = colours()
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputData(shapes)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("value")
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(*value_range)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    if is_flat(data):
        actor.GetProperty().LightingOff()
    else:
        actor.GetProperty().SetAmbient(0.6)
        actor.GetProperty().SetDiffuse(0.4)
    if not is_points:
        actor.GetProperty().EdgeVisibilityOn()

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    if args.mesh:
        edges = vtk.vtkDataSetMapper()
        edges.SetInputData(read(args.mesh))
        edges.ScalarVisibilityOff()
        wires = vtk.vtkActor()
        wires.SetMapper(edges)
        wires.GetProperty().SetRepresentationToWireframe()
        wires.GetProperty().SetColor(0.4, 0.4, 0.4)
        renderer.AddActor(wires)

    font = max(12, args.size[1] // 35)
    title = args.title or " ".join([args.field, args.component]).strip()
    if args.unit:
        title += f" [{args.unit}]"
    renderer.AddActor2D(colour_bar(table, font))
    renderer.AddActor2D(title_above_bar(title, font))
    look_at(renderer, shapes, args.size[0] / args.size[1])
    renderer.AddActor(axes(shapes, renderer, args.length_unit, font))

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*args.size)
    window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(args.output)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


main()
