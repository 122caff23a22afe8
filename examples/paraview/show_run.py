#!/usr/bin/env python3
"""Shows a run folder of Ripstop in ParaView: canopy by stress, lines by tension, a slice and streamlines of the flow.

    pvpython examples/paraview/show_run.py RUN [--picture FILE.png]
    python3 examples/paraview/show_run.py --check RUN        (VTK only: checks that all files are complete)

Inside ParaView (paraview --script=...) the folder is taken from the environment variable RIPSTOP_RUN.
"""
import os
import pathlib
import sys
import xml.etree.ElementTree

CANOPY_ARRAY = "von_mises_n_per_m"
LINES_ARRAY = "tension_n"
FLOW_ARRAY = "velocity_m_per_s"


def files_of(run):
    """The series of shapes, and the flow where the run has one."""
    run = pathlib.Path(run)
    found = {"canopy": run / "canopy.pvd", "lines": run / "lines.pvd"}
    for name in found.values():
        if not name.exists():
            sys.exit(f"{run}: has no {name.name}; is it a folder of ripstop steady or ripstop inflate?")
    for name in ("flow.vtr", "flow.vti"):
        if (run / name).exists():
            found["flow"] = run / name
    return found


def last_of(series):
    """The newest file that a .pvd names."""
    sets = xml.etree.ElementTree.parse(series).getroot().iter("DataSet")
    return series.parent / max(sets, key=lambda s: float(s.get("timestep"))).get("file")


def check(run):
    import vtk  # pylint: disable=import-outside-toplevel

    readers = {".vtp": vtk.vtkXMLPolyDataReader, ".vtr": vtk.vtkXMLRectilinearGridReader, ".vti": vtk.vtkXMLImageDataReader}
    wanted = {"canopy": CANOPY_ARRAY, "lines": LINES_ARRAY, "flow": FLOW_ARRAY}
    for name, path in files_of(run).items():
        path = last_of(path) if path.suffix == ".pvd" else path
        reader = readers[path.suffix]()
        reader.SetFileName(str(path))
        reader.Update()
        data = reader.GetOutput()
        if data.GetNumberOfCells() == 0 or not data.GetCellData().HasArray(wanted[name]):
            sys.exit(f"{path}: has no cells with {wanted[name]}")
        low, high = data.GetCellData().GetArray(wanted[name]).GetRange(-1)
        print(f"{name}: {data.GetNumberOfCells()} cells, {wanted[name]} from {low:.6g} to {high:.6g}")


def coloured(simple, source, array, view, width=None):
    display = simple.Show(source, view)
    simple.ColorBy(display, ("CELLS", array))
    display.RescaleTransferFunctionToDataRange(True, False)
    display.SetScalarBarVisibility(view, True)
    if width:
        display.LineWidth = width
    return display


def show_flow(simple, path, view):
    reader = (simple.XMLRectilinearGridReader if path.suffix == ".vtr" else simple.XMLImageDataReader)(FileName=[str(path)])
    slice_of = simple.Slice(Input=reader)
    slice_of.SliceType.Origin = [0, 0, 0]
    slice_of.SliceType.Normal = [1, 0, 0]
    coloured(simple, slice_of, FLOW_ARRAY, view)
    points = simple.CellDatatoPointData(Input=reader)
    lines = simple.StreamTracer(Input=points, SeedType="Point Cloud", Vectors=["POINTS", FLOW_ARRAY])
    low, high = reader.GetDataInformation().GetBounds()[0::2], reader.GetDataInformation().GetBounds()[1::2]
    lines.SeedType.Center = [0, 0, low[2] + 0.3 * (high[2] - low[2])]
    lines.SeedType.Radius = 0.15 * (high[0] - low[0])
    lines.MaximumStreamlineLength = 2 * (high[2] - low[2])
    simple.Show(lines, view).Opacity = 0.5


def show(run, picture=None):
    from paraview import simple  # pylint: disable=import-outside-toplevel,import-error

    files = files_of(run)
    view = simple.GetActiveViewOrCreate("RenderView")
    coloured(simple, simple.PVDReader(FileName=str(files["canopy"])), CANOPY_ARRAY, view)
    coloured(simple, simple.PVDReader(FileName=str(files["lines"])), LINES_ARRAY, view, width=2)
    if "flow" in files:
        show_flow(simple, files["flow"], view)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().GoToLast()
    # The stream comes from the left and enters the mouth of the canopy.
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [-4, 2, 0], [0, 0, 0], [0, 1, 0]
    simple.ResetCamera(view)
    simple.Render(view)
    if picture:
        simple.SaveScreenshot(str(picture), view)
    elif sys.argv[0].endswith("show_run.py"):
        simple.Interact()


def main(arguments):
    if arguments[:1] == ["--check"] and len(arguments) == 2:
        return check(arguments[1])
    run = arguments[0] if arguments else os.environ.get("RIPSTOP_RUN")
    if not run:
        sys.exit(__doc__)
    return show(run, arguments[2] if arguments[1:2] == ["--picture"] else None)


if __name__ == "__main__" or "RIPSTOP_RUN" in os.environ:
    main(sys.argv[1:])
