"""Opens a Cupola run in ParaView: `paraview --script=open_in_paraview.py` in the folder of this file.

Reads the files in the current folder, or in the folder CUPOLA_POST. Left view: the blocks, coloured by the hoop force, or by
the bodies of the mechanism if the structure is not at rest. Right view: the forces inside the transparent blocks, if it is
at rest. Layers that are not shown at first are listed in the Pipeline Browser.
"""
import os

from paraview.simple import *

folder = os.environ.get("CUPOLA_POST") or os.getcwd()
if not os.path.exists(os.path.join(folder, "blocks.pvd")):
    raise SystemExit(folder + ": no blocks.pvd; start ParaView in the folder post of a run, or set CUPOLA_POST")
STONE = (0.85, 0.83, 0.78)
# (file, visible at first, line width, coloured by an array or in one colour)
LAYERS = [
    ("joint_forces.vtp", True, 2.0, "force_magnitude_N"),
    ("thrust_lines.vtp", True, 3.0, (0.9, 0.45, 0.0)),
    ("ties.vtp", True, 5.0, "force_N"),
    ("wrenches.vtp", False, 2.0, "resultant_N"),
    ("sections.vtp", False, 2.0, (0.1, 0.1, 0.1)),
    ("cracks.vtp", False, 3.0, (0.75, 0.0, 0.0)),
]


def white(view):
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = [0, 0, 0]
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [-0.6, -1.0, 0.55], [0, 0, 0], [0, 0, 1]
    return view


def one_colour(display, rgb):
    display.ColorArrayName = ("POINTS", "")
    display.AmbientColor = display.DiffuseColor = list(rgb)


def by_array(display, view, array, title, visible=True, symmetric=False):
    ColorBy(display, ("CELLS", array))
    table = GetColorTransferFunction(array)
    table.ApplyPreset("Cool to Warm" if symmetric else "Viridis (matplotlib)", True)
    if symmetric:  # compression is positive: blue; tension red
        table.InvertTransferFunction()
        most = max(abs(table.RGBPoints[0]), abs(table.RGBPoints[-4]), 1e-12)
        table.RescaleTransferFunction(-most, most)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = bar.LabelFontSize = 12
    bar.WindowLocation = "Lower Right Corner"
    display.SetScalarBarVisibility(view, visible)


def read(name, reader):
    source = reader(registrationName=name, FileName=[os.path.join(folder, name)] if reader is XMLPolyDataReader
                    else os.path.join(folder, name))
    source.UpdatePipeline()
    return source


left = white(GetActiveViewOrCreate("RenderView"))
layout = GetLayout(left)
layout.SplitHorizontal(layout.GetViewLocation(left), 0.5)
right = white(CreateView("RenderView"))
AssignViewToLayout(view=right, layout=layout)

blocks = read("blocks.pvd", PVDReader)
times = blocks.TimestepValues if hasattr(blocks.TimestepValues, "__len__") else [blocks.TimestepValues]
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = times[-1]
blocks.UpdatePipeline(times[-1])
at_rest = blocks.CellData.GetArray("mechanism_group").GetRange()[1] == 0  # otherwise the bodies are numbered from 1
hoop = blocks.CellData.GetArray("hoop_force_N_per_m")
low, high = hoop.GetRange() if hoop else (0.0, 0.0)
shown = Show(blocks, left)
shown.Representation, shown.EdgeColor = "Surface With Edges", [0.3, 0.3, 0.3]
if at_rest and low == low and high > low:  # not NaN, not all zero
    by_array(shown, left, "hoop_force_N_per_m", "hoop force (N/m), compression positive", symmetric=True)
else:
    by_array(shown, left, "mechanism_group", "body of the mechanism")
ghost = Show(blocks, right)
ghost.Representation, ghost.Opacity = "Surface", 0.15
one_colour(ghost, STONE)

for name, visible, width, colour in LAYERS:
    if not os.path.exists(os.path.join(folder, name)):
        continue
    layer = read(name, XMLPolyDataReader)
    if layer.GetDataInformation().GetNumberOfCells() == 0:
        Delete(layer)
        continue
    visible = visible and at_rest  # the forces of a motion are those of one instant
    display = Show(layer, right)
    display.LineWidth = width
    if isinstance(colour, str):
        by_array(display, right, colour, colour.replace("_N", " (N)").replace("_", " "), visible)
    else:
        one_colour(display, colour)
    if not visible:
        Hide(layer, right)

for view in (left, right):
    ResetCamera(view)
AddCameraLink(left, right, "Cupola")
SetActiveView(left)
SetActiveSource(blocks)
RenderAllViews()
