#!/usr/bin/env python3
"""Writes the "Cornell chickens" of the paper's figure 8: a box with two chickens and an egg, in
millimetres.

The room is the Cornell box without its irregularities, open towards the camera "front" unless
--closed. Every surface is glossy, max-Phong of shine 10, with the albedos of paper section 6.
"""
import math
from pathlib import Path

from implicit import blended, ellipsoid, limb, surface_of
from mesh import Material, Scene, Shape, grey, lathe, parse_arguments, write_scene

WIDTH, HEIGHT, DEPTH = 556.0, 548.8, 559.2
LIGHT = (213.0, 343.0, 227.0, 332.0)  # x, z
LIGHT_GAP = FLOOR_GAP = 0.5
SHINE = 10

MATERIALS = {
    "white": Material((0.60, 0.59, 0.56), ks=grey(0.2), ns=SHINE),
    "red": Material((0.58, 0.05, 0.04), ks=grey(0.2), ns=SHINE),
    "green": Material((0.10, 0.42, 0.07), ks=grey(0.2), ns=SHINE),
    "egg": Material(grey(0.0), ks=grey(0.9), ns=SHINE),
    "hen": Material((0.40, 0.22, 0.05), ks=grey(0.5), ns=SHINE),
    "cock": Material((0.10, 0.20, 0.40), ks=grey(0.5), ns=SHINE),
    "light": Material(grey(0.0), ke=(30.0, 26.0, 20.0)),
}


def chicken(material, head, comb, tail, cell):
    """Looks along +x, stands on y = 0, about 210 tall. `head` is the middle of its head (x, y);
    `comb` and `tail` are sizes, 1 for a hen's."""
    hx, hy = head
    bodies = [
        (ellipsoid((0, 98, 0), (74, 50, 50), 14), 0),
        (ellipsoid((-72, 112 + 20 * tail, 0), (22 + 14 * tail, 30 * tail + 12, 17), 35), 34),
        (limb((42, 110, 0), (hx - 6, hy - 8, 0), 33, 20), 34),
        (ellipsoid((hx, hy, 0), (27, 24, 21)), 12),
        (limb((hx + 17, hy - 2, 0), (hx + 40, hy - 9, 0), 11, 7), 6),
        (ellipsoid((hx + 17, hy - 27, 0), (8, 14, 8)), 5),
    ]
    for dx, dy in ((-14, 16), (0, 22), (14, 18)):
        bodies.append((ellipsoid((hx + dx, hy + dy + 4 * comb, 0),
                                 (9, 9 + 6 * comb, 7.5), -dx), 5))
    for side in (-1, 1):
        bodies += [
            (ellipsoid((-8, 102, side * 43), (52, 30, 16), 22), 10),
            (limb((4, 62, side * 20), (8, 46, side * 23), 19, 11), 12),
            (limb((8, 46, side * 23), (4, 11, side * 25), 9, 11), 6),
        ]
        for toe in ((38, 9, side * 40), (42, 9, side * 16), (-22, 9, side * 25)):
            bodies.append((limb((4, 10, side * 25), toe, 9, 8), 6))
    return surface_of(blended(bodies), (-135, -6, -75), (170, 285, 75), cell, material)


def egg(length, segments, material):
    """A smooth curve of revolution, blunt end down."""
    profile = [(0.0, 0.0)]
    rings = segments * 5 // 8
    for i in range(1, rings):
        t = math.pi * i / rings
        y = (1 - math.cos(t)) / 2
        profile.append((0.37 * length * math.sin(t) * (1.08 - 0.22 * y), y * length))
    return lathe(profile + [(0.0, length)], segments, material)


def room(closed):
    """Faces look inwards."""
    corners = [(x, y, z) for z in (0.0, DEPTH) for y in (0.0, HEIGHT) for x in (0.0, WIDTH)]
    faces = [([0, 4, 5, 1], "white"), ([2, 3, 7, 6], "white"), ([4, 6, 7, 5], "white"),
             ([0, 2, 6, 4], "green"), ([1, 5, 7, 3], "red")]
    if closed:
        faces.append(([0, 1, 3, 2], "white"))
    return Shape(corners, faces)


def standing(shape, x, z):
    low = min(v[1] for v in shape.vertices)
    return shape.moved(x, FLOOR_GAP - low, z)


def make_chickens(closed, cell):
    scene = Scene("Cornell chickens, millimetres", MATERIALS)
    scene.add_open("room", room(closed))
    x0, x1, z0, z1 = LIGHT
    y = HEIGHT - LIGHT_GAP
    scene.add_open("light", Shape([(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)],
                                  [([0, 1, 2, 3], "light")]))
    cock = chicken("cock", head=(76, 196), comb=2.2, tail=2.0, cell=cell).scaled(1.3, 1.3, 1.3)
    hen = chicken("hen", head=(88, 150), comb=1.0, tail=1.2, cell=cell).scaled(1.2, 1.2, 1.2)
    scene.add("cock", standing(cock.turned(205), 375, 330))
    scene.add("hen", standing(hen.turned(-35 + 90), 170, 300))
    scene.add("egg", standing(egg(112, 32, "egg").turned(12, "z"), 292, 120))
    scene.add_camera("front", (278, 273, -800), (278, 273, 0), 2 * math.degrees(math.atan(12.5 / 35)))
    scene.add_camera("inside", (278, 250, 12), (275, 130, 330), 80)
    return scene


def main():
    arguments = parse_arguments(
        __doc__,
        ("--closed", {"action": "store_true", "help": "add the front wall"}),
        ("--cell", {"type": float, "default": 8.3, "metavar": "MM",
                    "help": "about the chickens' triangles' edges (default: %(default)s)"}))
    name = "cornell_chickens_closed.obj" if arguments.closed else "cornell_chickens.obj"
    write_scene(make_chickens(arguments.closed, arguments.cell), Path(arguments.folder) / name)


if __name__ == "__main__":
    main()
