"""A stand-in for paraview.simple, for tests without ParaView: it has the functions that Cupola's scripts call.

Files are read with VTK, as ParaView does, so that a script fails if it names a file, an array or a code that the files of
a run do not have. Nothing is drawn. At the end it prints what was read and what was coloured, one line each.
"""
import atexit
import os
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

used = []
atexit.register(lambda: print("\n".join(sorted(set(used)))))


class Anything:
    """A view, a display, a legend: any attribute can be set, any method called."""

    def __getattr__(self, name):
        return lambda *args, **kwargs: Anything()


class Source:
    def __init__(self, data, name):
        self.data, self.name, self.cells = data, name, range(data.GetNumberOfCells())

    def UpdatePipeline(self, time=None):
        pass

    def UpdatePipelineInformation(self):
        pass

    @property
    def CellData(self):
        return self.data.GetCellData()

    def GetDataInformation(self):
        return self

    def GetNumberOfCells(self):
        return len(self.cells)

    def GetBounds(self):
        return self.data.GetBounds()


def data_of(path, reader):
    if not os.path.exists(path):
        raise RuntimeError(path + " does not exist")
    reader = reader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def XMLPolyDataReader(FileName, registrationName=None):
    (path,) = FileName
    used.append("file " + os.path.basename(path))
    return Source(data_of(path, vtkXMLPolyDataReader), path)


def PVDReader(FileName, registrationName=None):
    """The last of the times."""
    used.append("file " + os.path.basename(FileName))
    entries = ElementTree.parse(FileName).getroot().findall("./Collection/DataSet")
    path = os.path.join(os.path.dirname(FileName), entries[-1].get("file"))
    source = Source(data_of(path, vtkXMLUnstructuredGridReader), path)
    source.TimestepValues = [float(entry.get("timestep")) for entry in entries]
    return source


def array_of(source, association, name):
    if association != "CELLS" or not source.data.GetCellData().HasArray(name):
        raise RuntimeError("%s has no array %s of %s" % (source.name, name, association))
    return source.data.GetCellData().GetArray(name)


class Threshold(Source):
    """The cells with one value of an array; setting UpperThreshold selects them."""

    def __init__(self, Input, Scalars):
        super().__init__(Input.data, Input.name)
        self.scalars, self.values = Scalars, array_of(Input, *Scalars)

    def __setattr__(self, name, value):
        super().__setattr__(name, value)
        if name == "UpperThreshold":
            self.cells = [i for i in range(len(self.cells)) if self.values.GetValue(i) == value]
            if not self.cells:
                raise RuntimeError("%s has no cell with %s = %s" % (self.name, self.scalars[1], value))


def ExtractSurface(Input):
    return Input


def FeatureEdges(Input):
    return Anything()


def Show(source, view):
    display = Anything()
    display.source = source
    return display


def ColorBy(display, what):
    array_of(display.source, *what)
    used.append("array %s of %s" % (what[1], os.path.basename(display.source.name)))


def GetColorTransferFunction(name):
    table = Anything()
    table.RGBPoints = [0.0] * 8
    return table


def nothing(*args, **kwargs):
    return Anything()


GetActiveViewOrCreate = CreateView = GetLayout = AssignViewToLayout = GetAnimationScene = GetScalarBar = nothing
Hide = Delete = ResetCamera = AddCameraLink = SetActiveView = SetActiveSource = RenderAllViews = nothing
Render = SaveScreenshot = GetActiveCamera = nothing
