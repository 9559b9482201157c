"""Draws an assembly with ParaView.

    postproc/pictures/pvbatch.sh generators/pictures.py ASSEMBLY.vtu PREFIX [HEIGHT ...]

Writes PREFIX_outside.png, PREFIX_inside.png (the half behind the x-z plane) and, for each height in metres,
PREFIX_section_HEIGHT.png (the horizontal section seen from above, without supports). Colours show the kind of block:
flat, upright, support, imported. Lines are block boundaries and sharp edges.
"""
import sys

from paraview import servermanager, vtk
from paraview.simple import *

KIND_COLOURS = [(0.88, 0.84, 0.76), (0.85, 0.45, 0.28), (0.66, 0.68, 0.71), (0.80, 0.82, 0.74)]
SHARP = 0.94  # cosine of 20 deg: an edge inside a block is drawn if its faces enclose a larger angle
SIZE = [1400, 1000]  # px


def cells(source, array, low, high):
    """Cells whose value in an array lies between two bounds."""
    selected = Threshold(Input=source, Scalars=["CELLS", array])
    selected.LowerThreshold, selected.UpperThreshold = low, high
    return selected


def show_data(data, view):
    """Shows a VTK object that exists in this process."""
    producer = TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    return Show(producer, view)


def normal_of(points):
    """Unit normal of a polygon (Newell)."""
    normal = [0.0, 0.0, 0.0]
    for p, q in zip(points, points[1:] + points[:1]):
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            normal[i] += p[j] * q[k] - p[k] * q[j]
    length = sum(x * x for x in normal) ** 0.5 or 1.0
    return [x / length for x in normal]


def block_borders(faces, towards):
    """Edges between faces of different blocks, sharp edges and free edges, moved slightly towards the viewer."""
    shift = 1e-3 * faces.GetLength() / sum(x * x for x in towards) ** 0.5
    block = faces.GetCellData().GetArray("block")
    found = {}  # edge, as its two ends -> (block, normal) of each adjoining face
    for f in range(faces.GetNumberOfCells()):
        cell = faces.GetCell(f)
        if cell.GetCellDimension() != 2:
            continue
        centre = faces.GetPoint(cell.GetPointId(0))
        ids = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
        points = [faces.GetPoint(i) for i in ids]
        relative = [tuple(p[i] - centre[i] for i in range(3)) for p in points]
        keys = [tuple(round(x, 6) for x in p) for p in points]
        normal = normal_of(relative)
        for i, key in enumerate(keys):
            other = (i + 1) % len(keys)
            edge = (min(key, keys[other]), max(key, keys[other]))
            if edge[0] != edge[1]:
                found.setdefault(edge, []).append((block.GetTuple1(f), normal))
    lines, points = vtk.vtkCellArray(), vtk.vtkPoints()
    for edge, sides in found.items():
        if len(sides) == 2 and sides[0][0] == sides[1][0]:
            if abs(sum(x * y for x, y in zip(sides[0][1], sides[1][1]))) > SHARP:
                continue
        lines.InsertNextCell(2)
        for end in edge:
            lines.InsertCellPoint(points.InsertNextPoint([x + shift * y for x, y in zip(end, towards)]))
    borders = vtk.vtkPolyData()
    borders.SetPoints(points)
    borders.SetLines(lines)
    return borders


def picture(source, direction, name, flat=False):
    """Writes PREFIX_name.png, seen from a direction; `flat` for a section without perspective and shading."""
    view = CreateView("RenderView")
    view.ViewSize = SIZE
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    faces = servermanager.Fetch(source if flat else ExtractSurface(Input=source))
    display = show_data(faces, view)
    ColorBy(display, ("CELLS", "kind"))
    display.SetScalarBarVisibility(view, False)
    table = GetColorTransferFunction("kind")
    table.RGBPoints = [x for k, rgb in enumerate(KIND_COLOURS) for x in (k, *rgb)]
    table.Discretize = 0
    display.Ambient, display.Diffuse = (1.0, 0.0) if flat else (0.3, 0.75)
    lines = show_data(block_borders(faces, direction), view)
    lines.AmbientColor = lines.DiffuseColor = [0.2, 0.17, 0.15]
    lines.LineWidth = 1.2
    view.CameraParallelProjection = 1 if flat else 0
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = list(direction)
    view.CameraViewUp = [0, 1, 0] if flat else [0, 0, 1]
    ResetCamera(view)
    GetActiveCamera().Zoom(1.2)
    Render(view)
    SaveScreenshot("%s_%s.png" % (prefix, name), view, ImageResolution=SIZE)
    Delete(view)


if __name__ == "__main__":
    assembly_file, prefix, heights = sys.argv[1], sys.argv[2], [float(h) for h in sys.argv[3:]]
    model = XMLUnstructuredGridReader(FileName=[assembly_file])
    model.UpdatePipeline()
    picture(model, (-0.5, -1.0, 0.45), "outside")
    bounds = model.GetDataInformation().GetBounds()
    half = Clip(Input=model, ClipType="Plane", Crinkleclip=1, Invert=0)
    half.ClipType.Origin, half.ClipType.Normal = [0, 0.5 * (bounds[2] + bounds[3]), 0], [0, 1, 0]
    picture(half, (0.15, -1.0, 0.25), "inside")
    masonry = cells(model, "ring", 0, 1e9)
    for height in heights:
        cut = Slice(Input=masonry, SliceType="Plane", Triangulatetheslice=0)
        cut.SliceType.Origin, cut.SliceType.Normal = [0, 0, height], [0, 0, 1]
        picture(cut, (0.0, 0.0, 1.0), "section_%g" % height, flat=True)
