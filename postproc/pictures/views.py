"""Draws the standard views of a Cupola run: `pvbatch views.py`, or Macros > Import new macro in ParaView.

Reads the files in its own folder, or in the folder CUPOLA_POST, and writes pictures/NAME.png there.
"""
import os

from paraview.simple import *

folder = os.environ.get("CUPOLA_POST") or os.path.dirname(os.path.abspath(globals().get("__file__", "views.py")))
pictures = os.path.join(folder, "pictures")
os.makedirs(pictures, exist_ok=True)
STONE = (0.85, 0.83, 0.78)
OBLIQUE = (-0.6, -1.0, 0.55)


def path(name):
    return os.path.join(folder, name)


def new_view(direction, up=(0, 0, 1)):
    """A view of the model from the given direction."""
    view = CreateView("RenderView")
    view.ViewSize = [1200, 900]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = [0, 0, 0]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = list(direction)
    view.CameraViewUp = list(up)
    return view


def colour(display, view, association, array, title, diverging=False):
    """Colours by an array and adds a legend. Diverging colour maps are symmetric about zero."""
    ColorBy(display, (association, array))
    table = GetColorTransferFunction(array)
    table.ApplyPreset("Cool to Warm" if diverging else "Viridis (matplotlib)", True)
    if diverging:
        table.InvertTransferFunction()
        low, high = table.RGBPoints[0], table.RGBPoints[-4]
        most = max(abs(low), abs(high), 1e-12)
        table.RescaleTransferFunction(-most, most)
    table.NanColor = [0.74, 0.74, 0.74]
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = bar.LabelFontSize = 14
    display.SetScalarBarVisibility(view, True)


def plain(display, rgb):
    """Uses one colour instead of an array."""
    display.ColorArrayName = ("POINTS", "")
    display.AmbientColor = display.DiffuseColor = list(rgb)


def save(view, name):
    ResetCamera(view)
    GetActiveCamera().Dolly(1.35)
    Render(view)
    SaveScreenshot(os.path.join(pictures, name + ".png"), view, ImageResolution=[1200, 900])


def has_cells(source):
    source.UpdatePipeline()
    return source.GetDataInformation().GetNumberOfCells() > 0


def only(source, array, value):
    """The cells where the array has the given value."""
    picked = Threshold(Input=source, Scalars=["CELLS", array])
    picked.LowerThreshold = picked.UpperThreshold = value
    return picked


def show_blocks(view, blocks, array=None, title="", diverging=False, opacity=1.0):
    display = Show(blocks, view)
    display.Representation = "Surface"
    display.Opacity = opacity
    if opacity == 1.0:  # block edges, without the edges of the triangles that draw the faces
        outlines = FeatureEdges(Input=ExtractSurface(Input=blocks))
        outlines.FeatureAngle = 20.0
        outlines.Coloring = 0
        plain(Show(outlines, view), (0.25, 0.25, 0.25))
    if array:
        colour(display, view, "CELLS", array, title, diverging)
    else:
        plain(display, STONE)


series = PVDReader(FileName=path("blocks.pvd"))
series.UpdatePipelineInformation()
times = list(series.TimestepValues) if hasattr(series.TimestepValues, "__len__") else [series.TimestepValues]
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = times[-1]
series.UpdatePipeline(times[-1])

for name, array, title, diverging in [
    ("blocks_meridional", "meridional_force_N_per_m", "meridional force (N/m)", False),
    ("blocks_hoop", "hoop_force_N_per_m", "hoop force (N/m), compression positive", True),
    ("blocks_friction", "friction_use", "friction utilisation", False),
]:
    view = new_view(OBLIQUE)
    show_blocks(view, series, array, title, diverging)
    save(view, name)

joints = XMLPolyDataReader(FileName=[path("joint_forces.vtp")])
if has_cells(joints):
    view = new_view(OBLIQUE)
    show_blocks(view, series, opacity=0.15)
    display = Show(joints, view)
    display.LineWidth = 2.0
    colour(display, view, "CELLS", "force_magnitude_N", "joint resultant (N)")
    save(view, "joints")

lines = XMLPolyDataReader(FileName=[path("thrust_lines.vtp")])
if has_cells(lines):
    # Look perpendicular to the plane of the first meridian. The plane of an arch is x-z.
    first = only(lines, "meridian", 0)
    first.UpdatePipeline()
    low_x, high_x, low_y, high_y = first.GetDataInformation().GetBounds()[:4]
    x, y = (low_x + high_x) / 2, (low_y + high_y) / 2
    view = new_view((y, -x, 0.35 * (abs(x) + abs(y))) if abs(x) + abs(y) > 1e-3 * (high_x - low_x) else (0, -1, 0.2))
    show_blocks(view, series, opacity=0.05)
    for what, rgb, width in [(0, (0.84, 0.37, 0.0), 5.0), (3, (0, 0, 0), 2.0), (4, (0, 0, 0), 2.0)]:
        display = Show(only(lines, "what", what), view)
        plain(display, rgb)
        display.LineWidth = width
    save(view, "thrust_lines")

sections = XMLPolyDataReader(FileName=[path("sections.vtp")])
if has_cells(sections):
    view = new_view((-0.35, -0.6, 0.8))
    display = Show(only(sections, "what", 1), view)
    plain(display, STONE)
    display.Representation = "Surface With Edges"
    segments = Show(only(sections, "what", 0), view)
    segments.LineWidth = 4.0
    colour(segments, view, "CELLS", "resultant_N", "resultant on the part above (N)")
    save(view, "sections")

cracks = XMLPolyDataReader(FileName=[path("cracks.vtp")])
if has_cells(cracks):
    view = new_view(OBLIQUE)
    show_blocks(view, series, opacity=0.15)
    display = Show(cracks, view)
    display.LineWidth = 3.0
    colour(display, view, "CELLS", "opening_m", "opening (m)")
    save(view, "cracks")

if len(times) > 1:  # four pictures of the motion, the last frame included
    for i in range(4):
        scene.AnimationTime = times[(len(times) - 1) * (i + 1) // 4]
        view = new_view(OBLIQUE)
        show_blocks(view, series, "mechanism_group", "body of the mechanism")
        save(view, "motion_%d" % (i + 1))
