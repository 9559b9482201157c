"""The picture of README.md: postproc/pictures/pvbatch.sh docs/pictures/hero.py BLOCKS.vtu PICTURE.png

BLOCKS.vtu is post/blocks_0000.vtu of the case `brunelleschi`. Left: the bond, uprights in orange. Right: the same blocks
coloured by hoop force, tension red, compression blue.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "..", "..", "generators"))
from pictures import KIND_COLOURS, block_borders, cells, show_data
from paraview import servermanager
from paraview.simple import *

SIZE = [1440, 690]
TOWARDS_EYE = (-0.35, -1.0, 0.28)
LEFT, RIGHT = -26.6, 26.6  # m, places of the two domes along the picture's width
DROP = 3.8  # m by which the view is lowered, to leave room for the legend
TENSION, NEUTRAL, COMPRESSION = (0.79, 0.20, 0.12), (0.96, 0.95, 0.92), (0.16, 0.36, 0.62)


def show_dome(view, source, place, array, colours, title=None):
    across = (-TOWARDS_EYE[1], TOWARDS_EYE[0])
    length = (across[0] ** 2 + across[1] ** 2) ** 0.5
    moved = Transform(Input=ExtractSurface(Input=source))
    moved.Transform.Translate = [place * across[0] / length, place * across[1] / length, 0]
    faces = servermanager.Fetch(moved)
    display = show_data(faces, view)
    ColorBy(display, ("CELLS", array))
    display.Ambient, display.Diffuse = 0.35, 0.7
    table = GetColorTransferFunction(array)
    table.ColorSpace, table.Discretize, table.RGBPoints = "RGB", 0, colours
    display.SetScalarBarVisibility(view, title is not None)
    if title:
        bar = GetScalarBar(table, view)
        bar.Title, bar.ComponentTitle, bar.Orientation, bar.WindowLocation = title, "", "Horizontal", "Any Location"
        bar.Position, bar.ScalarBarLength, bar.ScalarBarThickness = [0.63, 0.02], 0.26, 14
        bar.UseCustomLabels, bar.CustomLabels, bar.AddRangeLabels = 1, [colours[0], 0, colours[-4]], 0
        bar.LabelFormat = "%-#.0f"
        bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
        bar.TitleFontSize = bar.LabelFontSize = 18
    borders = show_data(block_borders(faces, TOWARDS_EYE), view)
    borders.AmbientColor = borders.DiffuseColor = [0.2, 0.17, 0.15]
    borders.LineWidth = 1.3


blocks_file, picture_file = sys.argv[1:]
model = XMLUnstructuredGridReader(FileName=[blocks_file])
hoop = Calculator(Input=model, AttributeType="Cell Data", ResultArrayName="hoop", Function="hoop_force_N_per_m / 1000")
view = CreateView("RenderView")
view.ViewSize = SIZE
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
kinds = [x for kind, rgb in enumerate(KIND_COLOURS) for x in (kind, *rgb)]
show_dome(view, model, LEFT, "kind", kinds)
show_dome(view, cells(model, "ring", -1, -1), RIGHT, "kind", kinds)
show_dome(view, cells(hoop, "ring", 0, 1e9), RIGHT, "hoop", [-300, *TENSION, 0, *NEUTRAL, 600, *COMPRESSION], "hoop force, kN/m (tension negative)")
view.CameraParallelProjection = 1
view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = list(TOWARDS_EYE)
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
focus = list(view.CameraFocalPoint)
view.CameraFocalPoint = focus[:2] + [focus[2] - DROP]
view.CameraPosition = [focus[i] + 100 * TOWARDS_EYE[i] - (DROP if i == 2 else 0) for i in range(3)]
view.CameraParallelScale = 25.6
SaveScreenshot(picture_file, view, ImageResolution=SIZE, CompressionLevel="9")
