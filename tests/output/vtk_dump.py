"""Reads one file with VTK and prints its data as JSON, with values as their hexadecimal bytes in memory."""
import json
import sys
import xml.etree.ElementTree

import vtk

READERS = {
    "vtp": vtk.vtkXMLPolyDataReader,
    "vti": vtk.vtkXMLImageDataReader,
    "vtr": vtk.vtkXMLRectilinearGridReader,
    "vtu": vtk.vtkXMLUnstructuredGridReader,
    "stl": vtk.vtkSTLReader,
}


def read(path):
    reader = READERS[path.rsplit(".", 1)[1]]()
    errors = []
    for source in (reader, reader.GetExecutive()):
        source.AddObserver("ErrorEvent", lambda *event: errors.append(event))
    reader.SetFileName(path)
    if path.endswith(".stl"):
        reader.MergingOff()
    reader.Update()
    if errors:
        sys.exit("VTK could not read " + path)
    return reader.GetOutput()


def array(a):
    return {
        "name": a.GetName(),
        "type": a.GetDataTypeAsString(),
        "components": a.GetNumberOfComponents(),
        "bytes": bytes(memoryview(a)).hex() if a.GetNumberOfTuples() else "",
    }


def arrays(fields):
    return [array(fields.GetArray(i)) for i in range(fields.GetNumberOfArrays())]


def dump(path):
    data = read(path)
    result = {
        "class": data.GetClassName(),
        "point_arrays": arrays(data.GetPointData()),
        "cell_arrays": arrays(data.GetCellData()),
    }
    if data.GetClassName() == "vtkImageData":
        result["dimensions"] = data.GetDimensions()
        result["origin"] = data.GetOrigin()
        result["spacing"] = data.GetSpacing()
        return result
    if data.GetClassName() == "vtkRectilinearGrid":
        result["coordinates"] = [array(a) for a in (data.GetXCoordinates(), data.GetYCoordinates(), data.GetZCoordinates())]
        return result
    result["points"] = array(data.GetPoints().GetData())
    result["cells"] = []
    for i in range(data.GetNumberOfCells()):
        cell = data.GetCell(i)
        ids = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
        result["cells"].append({"type": cell.GetCellType(), "points": ids})
    return result


def dump_collection(path):
    folder = path.rsplit("/", 1)[0]
    entries = xml.etree.ElementTree.parse(path).getroot().find("Collection").findall("DataSet")
    return [
        {"time": float(e.get("timestep")), "class": read(folder + "/" + e.get("file")).GetClassName()}
        for e in entries
    ]


path = sys.argv[1]
print(json.dumps(dump_collection(path) if path.endswith(".pvd") else dump(path)))
