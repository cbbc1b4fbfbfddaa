#!/usr/bin/env python3
"""Writes the Sierpinski set of the paper's figure 7 in a closed room: 4479 triangles, metres.

1024 tetrahedra touch at their corners only (five levels of the set, 4096 triangles). A closed
surface has an even number of triangles, so the luminaire is an open one: a regular pentagon of 3
triangles below the ceiling. The room brings the remaining 380, as 190 rectangles. Colours are those
of paper section 6 at 700, 552 and 400 nm for red, green and blue.
"""
import math
from pathlib import Path

from mesh import Material, Scene, Shape, cos_sin, grey, parse_arguments, scale, add, write_scene

LEVELS = 5
ROOM = (6.0, 6.0, 6.0)       # x from -3 to 3, y from 0, z from -3 to 3
ROOM_CELLS = (5, 7, 5)       # 2 (5*7 + 7*5 + 5*5) = 190 rectangles
EDGE = 3.8                   # of the whole set
FLOOR_GAP = 0.6
LUMINAIRE_RADIUS, CEILING_GAP = 0.9, 0.02

MATERIALS = {
    "set": Material((0.06, 0.03, 0.09), ks=grey(0.8), ns=3),
    "white": Material((0.72, 0.72, 0.70)),
    "orange": Material((0.70, 0.42, 0.18)),
    "blue": Material((0.20, 0.38, 0.66)),
    "floor": Material((0.50, 0.50, 0.52)),
    "luminaire": Material(grey(0.0), ke=(16.0, 15.0, 13.5)),
}


def regular_tetrahedron(edge):
    """Base downwards, its centre above the origin."""
    radius, height = edge / math.sqrt(3), edge * math.sqrt(2 / 3)
    base = [(radius * cos_sin(a)[1], 0.0, radius * cos_sin(a)[0]) for a in (0, 120, 240)]
    return base + [(0.0, height, 0.0)]


def sierpinski(corners, levels):
    if levels == 0:
        return [corners]
    return [small for kept in corners
            for small in sierpinski([scale(add(kept, c), 0.5) for c in corners], levels - 1)]


def tetrahedra(corners, levels, material):
    shape = Shape()
    for a, b, c, top in sierpinski(corners, levels):
        n = len(shape.vertices)
        shape.vertices += [a, b, c, top]
        shape.faces += [([n + i for i in face], material)
                        for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))]
    return shape


def room(size, cells, material_of_side):
    """Faces look inwards; material by axis and side."""
    shape, numbers = Shape(), {}

    def vertex(place):
        if place not in numbers:
            numbers[place] = len(shape.vertices)
            x, y, z = (size[a] * place[a] / cells[a] for a in range(3))
            shape.vertices.append((x - size[0] / 2, y, z - size[2] / 2))
        return numbers[place]
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            for i in range(cells[u]):
                for j in range(cells[v]):
                    face = []
                    for di, dj in ((0, 0), (0, 1), (1, 1), (1, 0)):
                        place = [0, 0, 0]
                        place[axis], place[u], place[v] = side * cells[axis], i + di, j + dj
                        face.append(vertex(tuple(place)))
                    shape.faces.append((face if side else face[::-1], material_of_side(axis, side)))
    return shape


def side_material(axis, side):
    if axis == 0:
        return ("orange", "blue")[side]
    return ("floor", "white")[side] if axis == 1 else "white"


def make_sierpinski():
    scene = Scene("Sierpinski set in a room, metres", MATERIALS)
    scene.add_open("room", room(ROOM, ROOM_CELLS, side_material))
    pentagon = [(LUMINAIRE_RADIUS * c, ROOM[1] - CEILING_GAP, LUMINAIRE_RADIUS * s)
                for c, s in (cos_sin(72 * k) for k in range(5))]
    scene.add_open("luminaire", Shape(pentagon, [([0, 1, 2, 3, 4], "luminaire")]))
    the_set = tetrahedra(regular_tetrahedron(EDGE), LEVELS, "set")
    scene.add("set", the_set.turned(25).moved(y=FLOOR_GAP, z=-0.7))
    scene.add_camera("front", (0.2, 3.2, 2.95), (0.0, 2.45, -0.7), 84)
    scene.add_camera("below", (-2.4, 0.5, 2.4), (0.2, 2.5, -0.7), 75)
    return scene


def main():
    arguments = parse_arguments(__doc__)
    write_scene(make_sierpinski(), Path(arguments.folder) / "sierpinski.obj")


if __name__ == "__main__":
    main()
