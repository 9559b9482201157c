"""Pictures of an assembly: pvbatch generators/pictures.py ASSEMBLY.vtu PREFIX [HEIGHT ...]

Writes PREFIX_outside.png, PREFIX_inside.png (the half behind the x-z plane) and, for each height in metres,
PREFIX_section_HEIGHT.png (the level cut seen from above, supports left out).
"""
import sys

from paraview.simple import *

assembly_file, prefix, heights = sys.argv[1], sys.argv[2], [float(h) for h in sys.argv[3:]]
KINDS = {0: (0.88, 0.84, 0.76), 1: (0.85, 0.45, 0.28), 2: (0.6, 0.62, 0.65), 3: (0.80, 0.82, 0.74)}
OBLIQUE, FROM_ABOVE = (-0.5, -1.0, 0.45), (0.0, 0.0, 1.0)


def cells(source, array, low, high):
    picked = Threshold(Input=source, Scalars=["CELLS", array])
    picked.LowerThreshold, picked.UpperThreshold = low, high
    return picked


def picture(source, direction, name):
    """Draws the cells by kind: laid flat, upright, support, imported; edges are those of the parts."""
    view = CreateView("RenderView")
    view.ViewSize = [1400, 1000]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    for kind, rgb in KINDS.items():
        display = Show(cells(source, "kind", kind, kind), view)
        display.Representation = "Surface With Edges"
        display.ColorArrayName = ("POINTS", "")
        display.AmbientColor = display.DiffuseColor = list(rgb)
        display.EdgeColor = [0.25, 0.22, 0.2]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = list(direction)
    view.CameraViewUp = [0, 1, 0] if direction == FROM_ABOVE else [0, 0, 1]
    ResetCamera(view)
    GetActiveCamera().Dolly(1.3)
    Render(view)
    SaveScreenshot("%s_%s.png" % (prefix, name), view, ImageResolution=[1400, 1000])
    Delete(view)


model = XMLUnstructuredGridReader(FileName=[assembly_file])
model.UpdatePipeline()
picture(model, OBLIQUE, "outside")
bounds = model.GetDataInformation().GetBounds()
middle = 0.5 * (bounds[2] + bounds[3])
half = Clip(Input=model, ClipType="Plane", Crinkleclip=1, Invert=0)
half.ClipType.Origin, half.ClipType.Normal = [0, middle, 0], [0, 1, 0]
picture(half, (0.15, -1.0, 0.25), "inside")
masonry = cells(model, "ring", 0, 1e9)
for height in heights:
    cut = Slice(Input=masonry, SliceType="Plane", Triangulatetheslice=0)
    cut.SliceType.Origin, cut.SliceType.Normal = [0, 0, height], [0, 0, 1]
    picture(cut, FROM_ABOVE, "section_%g" % height)
