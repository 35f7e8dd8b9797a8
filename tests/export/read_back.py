# SPDX-License-Identifier: MIT
"""Reads exported files with the programs they are for: read_back.py FORMAT FOLDER. Prints what they hold, one number a line; exit code 77: the
reader is not installed."""
import sys

form, folder = sys.argv[1:]


def show(*numbers):
    for number in numbers:
        print(repr(float(number)))


try:
    if form in ("xyz", "lammps"):
        import ase.io

        if form == "xyz":
            frames = ase.io.read(folder + "/motion.xyz", ":")
            last = frames[-1]
            show(len(frames), len(last), last.info["Time"], last.positions[5][0], last.arrays["velo"][5][1], last.arrays["radius"][5],
                 last.get_velocities()[5][1], last.get_masses()[5], last.arrays["mass"][5], last.cell.lengths()[0])
        else:
            frames = ase.io.read(folder + "/motion.lammpstrj", ":", format="lammps-dump-text")
            last = frames[-1]
            show(len(frames), len(last), last.positions[5][0], last.get_velocities()[5][1] if last.get_velocities().any() else 0, last.cell.lengths()[0])
    elif form == "vtp":
        import re
        import vtk

        files = re.findall(r'timestep="([^"]+)" part="0" file="([^"]+)"', open(folder + "/motion.pvd").read())
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(folder + "/" + files[-1][1])
        reader.Update()
        grains = reader.GetOutput()
        data = grains.GetPointData()
        show(len(files), grains.GetNumberOfPoints(), files[-1][0], grains.GetPoint(5)[0], data.GetArray("velocity").GetTuple(5)[1], data.GetArray("radius").GetValue(5))
        reader.SetFileName(folder + "/" + files[-1][1].replace("grains_", "box_"))
        reader.Update()
        bounds = reader.GetOutput().GetBounds()
        show(bounds[1] - bounds[0])
    elif form == "npy":
        import numpy

        read = lambda name: numpy.load(f"{folder}/{name}.npy")
        show(len(read("time")), read("position").shape[1], read("time")[-1], read("position")[-1, 5, 0], read("velocity")[-1, 5, 1], read("radius")[5], read("box_size")[0])
    elif form == "csv":
        import csv

        rows = list(csv.DictReader(open(folder + "/motion.csv")))
        last = [row for row in rows if row["t_s"] == rows[-1]["t_s"]]
        show(len({row["t_s"] for row in rows}), len(last), last[5]["t_s"], last[5]["x_m"], last[5]["vy_m_per_s"], last[5]["radius_m"])
except ImportError as missing:
    print(missing)
    sys.exit(77)
