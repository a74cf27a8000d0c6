"""Writes the Gmsh fixtures of this folder (gmsh 4.15.2): python generate.py"""

import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)


def write(name):
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    for binary, suffix in ((0, "ascii"), (1, "binary")):
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.write(f"{name}_{suffix}.msh")


def rectangle(recombine):
    """2 m x 1 m from (0, 0), 4 x 3 quadrilaterals or twice as many triangles."""
    gmsh.clear()
    geo = gmsh.model.geo
    corners = [geo.addPoint(x, y, 0) for x, y in ((0, 0), (2, 0), (2, 1), (0, 1))]
    # The centre of an arc would be such a point: a node of the file that no cell uses.
    geo.addPoint(5, 5, 0)
    lines = [geo.addLine(corners[i], corners[(i + 1) % 4]) for i in range(4)]
    for line, points in zip(lines, (5, 4, 5, 4)):
        geo.mesh.setTransfiniteCurve(line, points)
    surface = geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.mesh.setTransfiniteSurface(surface)
    if recombine:
        geo.mesh.setRecombine(2, surface)
    geo.synchronize()
    gmsh.model.addPhysicalGroup(1, [lines[3]], name="left")
    gmsh.model.addPhysicalGroup(1, [lines[1]], name="right")
    gmsh.model.addPhysicalGroup(1, [lines[0], lines[2]], name="flat sides")
    gmsh.model.addPhysicalGroup(2, [surface], name="plate")
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    gmsh.model.mesh.generate(2)
    return surface


rectangle(True)
write("plate")
rectangle(False)
write("triangles")

surface = rectangle(True)
extruded = gmsh.model.geo.extrude([(2, surface)], 0, 0, 1.5, numElements=[2], recombine=True)
gmsh.model.geo.synchronize()
gmsh.model.removePhysicalGroups()
gmsh.model.addPhysicalGroup(2, [surface], name="back")
gmsh.model.addPhysicalGroup(2, [extruded[0][1]], name="front")
gmsh.model.addPhysicalGroup(3, [extruded[1][1]], name="block")
gmsh.model.mesh.generate(3)
write("block")
