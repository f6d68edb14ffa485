# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Draws VTU files of runs as PNG pictures, for plot.py.

Points are drawn as discs (balls in 3D) of the size of their volume, meshes and
the domains of points as cells with their edges; walls can be added as lines.
Several files become panels of one picture, with the same axes and colours.
Needs python3-vtk9, and the display of start_display().
"""

import atexit
import math
import os
import shutil
import subprocess
import sys

TENSOR = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"]
VECTOR = ["x", "y", "z"]


def fail(message):
    sys.exit(f"moraine plot: {message}")


def start_display():
    """Debian's VTK draws with X only, and ends the program where no X server
    answers. So it draws on a server of this program, which shows nothing."""
    if not shutil.which("Xvfb"):
        fail("fields are drawn on Xvfb, which is not here (Debian package "
             "xvfb)")
    # A server that is going down takes the socket of its number with it, also
    # from the next one: each run takes numbers of its own.
    for number in (100 + (os.getpid() + 997 * i) % 50000 for i in range(10)):
        ready, of_server = os.pipe()
        # By default it starts anew, deaf for a moment, when a client leaves.
        server = subprocess.Popen(
            ["Xvfb", f":{number}", "-displayfd", str(of_server), "-noreset",
             "-nolisten", "tcp", "-screen", "0", "1280x1024x24"],
            pass_fds=[of_server], stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(of_server)
        with open(ready) as answer:
            if answer.readline():
                atexit.register(stop, server)
                os.environ["DISPLAY"] = f":{number}"
                return
        stop(server)
    fail("Xvfb, on which fields are drawn, does not start")


def stop(server):
    server.terminate()
    server.wait()


def load_vtk():
    global vtk
    try:
        import vtk
    except ImportError:
        fail("fields are drawn by VTK, which is not here (Debian package "
             "python3-vtk9; it needs Debian's own python3)")


def read(path):
    """The data set of a VTU file."""
    if not os.path.isfile(path):
        fail(f"there is no file {path}")
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
        fail(f"{array.GetName()} has no component '{component}'; "
                 f"there are {', '.join(names)}, magnitude")
    return names.index(component)


def add_value(data, field, component):
    """Add the numbers to draw as the point array 'value'; return their range."""
    fields = data.GetPointData()
    array = fields.GetArray(field)
    if array is None:
        names = [fields.GetArrayName(i)
                 for i in range(fields.GetNumberOfArrays())]
        fail(f"no field '{field}'; there are {', '.join(names)}")
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


def magnified(data, factor):
    """Points at this many times their displacement."""
    data.GetPointData().SetActiveVectors("displacement")
    warp = vtk.vtkWarpVector()
    warp.SetInputData(data)
    warp.SetScaleFactor(factor - 1)
    warp.Update()
    return warp.GetOutput()


def as_glyphs(data, scale):
    """A disc (3D: ball) of its volume for every point."""
    fields = data.GetPointData()
    volume = fields.GetArray("volume")
    size = vtk.vtkDoubleArray()
    size.SetName("size")
    size.SetNumberOfTuples(data.GetNumberOfPoints())
    flat = is_flat(data)
    for i in range(data.GetNumberOfPoints()):
        v = volume.GetValue(i)
        size.SetValue(i, (v / math.pi) ** 0.5 if flat else
                      (0.75 * v / math.pi) ** (1.0 / 3.0))
    fields.AddArray(size)
    fields.SetActiveScalars("size")

    if flat:
        shape = vtk.vtkRegularPolygonSource()
        shape.SetNumberOfSides(20)
        shape.GeneratePolylineOff()
    else:
        shape = vtk.vtkSphereSource()
        shape.SetThetaResolution(12)
        shape.SetPhiResolution(12)
    shape.SetRadius(scale)
    glyphs = vtk.vtkGlyph3D()
    glyphs.SetInputData(data)
    glyphs.SetSourceConnection(shape.GetOutputPort())
    glyphs.SetScaleModeToScaleByScalar()
    glyphs.SetColorModeToColorByScalar()
    glyphs.OrientOff()
    glyphs.Update()
    return glyphs.GetOutput()


VIRIDIS = [(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142),
           (33, 144, 141), (39, 173, 129), (92, 200, 99), (170, 220, 50),
           (253, 231, 37)]


def colours(diverging):
    """Dark blue over green to yellow, or blue over white to red."""
    function = vtk.vtkColorTransferFunction()
    if diverging:
        function.SetColorSpaceToDiverging()
        function.AddRGBPoint(0.0, 0.230, 0.299, 0.754)
        function.AddRGBPoint(1.0, 0.706, 0.016, 0.150)
    else:
        for i, rgb in enumerate(VIRIDIS):
            function.AddRGBPoint(i / (len(VIRIDIS) - 1),
                                 *(c / 255.0 for c in rgb))
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


def colour_bar(table, size, width):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    text_style(bar.GetLabelTextProperty(), size)
    bar.SetPosition(1 - 7.0 * size / width, 0.14)
    bar.SetWidth(6.0 * size / width)
    bar.SetHeight(0.65)
    bar.SetBarRatio(0.25)
    return bar


def text_at(words, size, x, y, justification):
    """A text of its own; the bar would cut off what is wider than itself."""
    text = vtk.vtkTextActor()
    text.SetInput(words)
    text_style(text.GetTextProperty(), size)
    getattr(text.GetTextProperty(), f"SetJustificationTo{justification}")()
    text.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    text.SetPosition(x, y)
    return text


def edge_lines(data):
    """The edges of a mesh as thin grey lines behind everything else."""
    edges = vtk.vtkExtractEdges()
    edges.SetInputData(data)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.8, 0.8, 0.83)
    actor.GetProperty().LightingOff()
    if is_flat(data):
        actor.SetPosition(0, 0, -0.1)
        # Thinner ones may vanish between the pixels.
        actor.GetProperty().SetLineWidth(2)
    return actor


def grid(x0, y0, x1, y1, h):
    """A flat mesh of squares, for results that have no mesh file."""
    data = vtk.vtkRectilinearGrid()
    n = [round((x1 - x0) / h) + 1, round((y1 - y0) / h) + 1]
    data.SetDimensions(n[0], n[1], 1)
    for name, start, count in (("X", x0, n[0]), ("Y", y0, n[1])):
        places = vtk.vtkDoubleArray()
        for i in range(count):
            places.InsertNextValue(start + i * h)
        getattr(data, f"Set{name}Coordinates")(places)
    return data


def wall_line(coordinates):
    """A thick line through x, y, x, y, ... in front of everything else."""
    points = vtk.vtkPoints()
    line = vtk.vtkPolyLine()
    line.GetPointIds().SetNumberOfIds(len(coordinates) // 2)
    for i in range(len(coordinates) // 2):
        points.InsertNextPoint(coordinates[2 * i], coordinates[2 * i + 1], 0.1)
        line.GetPointIds().SetId(i, i)
    cells = vtk.vtkCellArray()
    cells.InsertNextCell(line)
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(cells)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.1, 0.1, 0.1)
    actor.GetProperty().SetLineWidth(4)
    actor.GetProperty().LightingOff()
    return actor


def union(boxes):
    return [(min, max)[i % 2](box[i] for box in boxes) for i in range(6)]


def axes(bounds, flat, renderer, unit, size):
    actor = vtk.vtkCubeAxesActor()
    actor.SetBounds(bounds)
    actor.SetCamera(renderer.GetActiveCamera())
    for name, direction in zip("XYZ", range(3)):
        getattr(actor, f"Set{name}Title")(name.lower())
        getattr(actor, f"Set{name}Units")(unit)
        text_style(actor.GetTitleTextProperty(direction), size)
        text_style(actor.GetLabelTextProperty(direction), size)
        getattr(actor, f"Get{name}AxesLinesProperty")().SetColor(0, 0, 0)
    actor.SetFlyModeToOuterEdges()
    actor.SetScreenSize(size)
    actor.XAxisMinorTickVisibilityOff()
    actor.YAxisMinorTickVisibilityOff()
    actor.ZAxisMinorTickVisibilityOff()
    actor.SetTickLocationToOutside()
    if flat:
        actor.SetUse2DMode(1)
        actor.ZAxisVisibilityOff()
    return actor


def panel_size(bounds, height, font):
    """Width and height in pixels of a flat panel, and pixels per length."""
    plot_height = height - 7 * font
    scale = plot_height / (bounds[3] - bounds[2])
    scale = min(scale, 2.4 * height / (bounds[1] - bounds[0]))
    return [int((bounds[1] - bounds[0]) * scale + 8 * font),
            int((bounds[3] - bounds[2]) * scale + 7 * font)], scale


def look_at(renderer, bounds, flat, size, scale, font):
    """The whole panel, with room for the axes."""
    camera = renderer.GetActiveCamera()
    centre = [(bounds[2 * d] + bounds[2 * d + 1]) / 2 for d in range(3)]
    camera.ParallelProjectionOn()
    if flat:
        height = size[1] / scale
        centre[0] = bounds[0] + (size[0] / 2 - 6 * font) / scale
        centre[1] = bounds[2] + (size[1] / 2 - 5 * font) / scale
        camera.SetPosition(centre[0], centre[1], 1)
        camera.SetViewUp(0, 1, 0)
    else:
        diagonal = sum((bounds[2 * d + 1] - bounds[2 * d])**2
                       for d in range(3)) ** 0.5
        height = 1.1 * diagonal
        centre[1] += 0.05 * diagonal
        camera.SetPosition(centre[0] + diagonal, centre[1] - 1.6 * diagonal,
                           centre[2] + diagonal)
        camera.SetViewUp(0, 0, 1)
    camera.SetFocalPoint(centre)
    camera.SetParallelScale(height / 2)
    renderer.ResetCameraClippingRange()


def add_arguments(parser):
    """How a picture looks; what it shows is left to the caller."""
    parser.add_argument("--label", nargs="+", default=[],
                        help="above each panel")
    parser.add_argument("--columns", type=int, default=1, help="of panels")
    parser.add_argument("--mesh", nargs="+", default=[],
                        help="VTU files whose cell edges are drawn too: one, "
                        "or one per panel; of a run its mesh if left out")
    parser.add_argument("--grid", nargs=5, type=float,
                        metavar=("X0", "Y0", "X1", "Y1", "H"),
                        help="instead of --mesh: squares of size H")
    parser.add_argument("--point-scale", type=float, default=1.0,
                        help="size of points over that of their volume")
    parser.add_argument("--magnify", type=float, default=1.0, metavar="FACTOR",
                        help="draw points at this many times their "
                        "displacement")
    parser.add_argument("--wall", nargs="+", type=float, action="append",
                        default=[], metavar="X Y",
                        help="a line through these points, in 2D")
    parser.add_argument("--wall-of", nargs="+", type=float, action="append",
                        default=[], metavar="PANEL X Y",
                        help="the same in one panel, counted from 1")
    parser.add_argument("--heading", default="", help="above the picture")
    parser.add_argument("--diverging", action="store_true",
                        help="colours from blue over white to red")
    parser.add_argument("--component", default="",
                        help="of the field: x, y, z; xx, xy, ...; magnitude")
    parser.add_argument("--range", nargs=2, type=float,
                        help="values at the ends of the colour bar")
    parser.add_argument("--title", help="title of the colour bar")
    parser.add_argument("--unit", default="", help="unit in that title")
    parser.add_argument("--length-unit", default="", help="unit of the axes")
    parser.add_argument("--size", nargs=2, type=int, default=[1000, 700],
                        help="pixels of a panel; in 2D the width follows from "
                        "the height")


class Panel:
    """What one file shows."""

    def __init__(self, args, number):
        self.args = args
        self.data = read(args.files[number])
        self.range = add_value(self.data, args.field, args.component)
        self.flat = is_flat(self.data)
        # The domains of points have their fields too.
        self.is_points = self.data.GetCellType(0) == vtk.VTK_VERTEX
        if self.is_points and args.magnify != 1:
            self.data = magnified(self.data, args.magnify)
        self.shapes = as_glyphs(self.data, args.point_scale) \
            if self.is_points else self.data
        self.walls = args.wall + [wall[1:] for wall in args.wall_of
                                  if wall[0] == number + 1]
        self.label = args.label[number] if number < len(args.label) else ""
        self.mesh = None
        if args.mesh:
            self.mesh = read(args.mesh[min(number, len(args.mesh) - 1)])
        elif args.grid:
            self.mesh = grid(*args.grid)

    def bounds(self):
        boxes = [self.shapes.GetBounds()]
        if self.mesh:
            boxes.append(self.mesh.GetBounds())
        boxes += [[min(wall[0::2]), max(wall[0::2]), min(wall[1::2]),
                   max(wall[1::2]), 0, 0] for wall in self.walls]
        return union(boxes)

    def actor(self, table, value_range):
        mapper = vtk.vtkDataSetMapper()
        mapper.SetInputData(self.shapes)
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("value")
        mapper.SetLookupTable(table)
        mapper.SetScalarRange(*value_range)
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        if self.flat:
            actor.GetProperty().LightingOff()
        else:
            actor.GetProperty().SetAmbient(0.6)
            actor.GetProperty().SetDiffuse(0.4)
        if not self.is_points:
            actor.GetProperty().EdgeVisibilityOn()
        return actor

    def renderer(self, table, value_range, bounds, size, scale, font):
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        renderer.AddActor(self.actor(table, value_range))
        if self.mesh:
            renderer.AddActor(edge_lines(self.mesh))
        for wall in self.walls:
            renderer.AddActor(wall_line(wall))
        look_at(renderer, bounds, self.flat, size, scale, font)
        renderer.AddActor(axes(bounds, self.flat, renderer,
                               self.args.length_unit, font))
        renderer.AddActor2D(text_at(self.label, font, 6 * font / size[0],
                                    1 - 1.5 * font / size[1], "Left"))
        return renderer


def title(args):
    words = args.title or " ".join([args.field, args.component]).strip()
    return words + (f" [{args.unit}]" if args.unit else "")


def legend(words, table, font, size):
    """Title and colour bar, at the right of all panels."""
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor2D(colour_bar(table, font, size[0]))
    renderer.AddActor2D(text_at(words, font, 0.95, 0.84, "Right"))
    return renderer


def heading(words, font, size):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor2D(text_at(words, font, font / size[0], 0.1, "Left"))
    return renderer


def image_of(renderer, size):
    """Each renderer has a window of its own: axes are labelled in the lower
    left part of a window only."""
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.Update()
    return image.GetOutput()


def joined(images, axis):
    """Images beside (0) or above (1) each other, the first at left or below."""
    append = vtk.vtkImageAppend()
    append.SetAppendAxis(axis)
    for image in images:
        append.AddInputData(image)
    append.Update()
    return append.GetOutput()


def write_table(panels, path):
    """Position and value of all points."""
    with open(path, "w") as file:
        file.write("x,y,z,value\n")
        for data in (panel.data for panel in panels):
            values = data.GetPointData().GetArray("value")
            for i in range(data.GetNumberOfPoints()):
                row = (*data.GetPoint(i), values.GetValue(i))
                file.write(",".join(f"{number:.8g}" for number in row) + "\n")


def draw(args, path):
    """Draw args.files as the PNG file `path`, or write a CSV table of them.
    First of all call start_display()."""
    load_vtk()
    panels = [Panel(args, i) for i in range(len(args.files))]
    if path.endswith(".csv"):
        write_table(panels, path)
        return
    bounds = union([panel.bounds() for panel in panels])
    low, high = zip(*(panel.range for panel in panels))
    value_range = args.range or (min(low), max(high))
    table = colours(args.diverging)
    table.SetTableRange(*value_range)

    font = max(16, args.size[1] // 35)
    size, scale = panel_size(bounds, args.size[1], font) \
        if panels[0].flat else (args.size, 1)
    images = [image_of(panel.renderer(table, value_range, bounds, size, scale,
                                      font), size) for panel in panels]
    write_png(page(args, images, table, font), path)


def page(args, images, table, font):
    """The panels in rows, the colour bar beside and the heading above them."""
    columns = args.columns
    if len(images) % columns:
        fail("the panels do not fill the columns")
    rows = [joined(images[i:i + columns], 0)
            for i in range(0, len(images), columns)]
    picture = joined(rows[::-1], 1)
    side = [max(9 * font, int(0.62 * font * len(title(args)))),
            picture.GetDimensions()[1]]
    picture = joined([picture, image_of(legend(title(args), table, font, side),
                                        side)], 0)
    top = [picture.GetDimensions()[0], 2 * font + 4]
    return joined([picture,
                   image_of(heading(args.heading, font + 4, top), top)], 1)


def write_png(picture, path):
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetCompressionLevel(9)
    writer.SetInputData(picture)
    writer.Write()
