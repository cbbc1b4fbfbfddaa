#!/usr/bin/env python3
"""Writes a house of about 31 000 polygons for the walk-through of the paper's figures 9 and 10, in
metres: hall, living room, kitchen, study and shower below; a gallery, three bedrooms and a bath
above; roof and garden. Beside house.obj, house.path holds key frames of a walk living room - hall -
kitchen, one a line:

    time [s]  eye  look-at  up  vertical field of view [degrees]
"""
import math
import random
from pathlib import Path

import fittings
import furniture
from house_plan import (CEILING, DOORS, GARDEN, HEIGHT, PLAN, ROOMS, STAIRS, UPPER, WINDOWS, WALK, shell)
from mesh import Material, Scene, Shape, ball, box, cushion, cylinder, grey, lathe, tube
from mesh import parse_arguments, prism, write_scene

GLOSS = grey(0.15)

MATERIALS = {
    "plaster": Material((0.76, 0.72, 0.62)), "ceiling": Material(grey(0.80)),
    "concrete": Material(grey(0.45)), "warm_white": Material((0.78, 0.74, 0.66)),
    "sand": Material((0.72, 0.60, 0.43)), "sage": Material((0.55, 0.62, 0.48)),
    "sky": Material((0.52, 0.62, 0.72)), "rose": Material((0.74, 0.56, 0.52)),
    "parquet": Material((0.40, 0.24, 0.12), GLOSS, 10), "tiles": Material((0.50, 0.48, 0.44), GLOSS, 10),
    "wall_tiles": Material((0.58, 0.66, 0.68), GLOSS, 10), "tread": Material((0.42, 0.26, 0.13), GLOSS, 10),
    "paint": Material(grey(0.74)), "oak": Material((0.52, 0.36, 0.20)), "walnut": Material((0.26, 0.15, 0.08)),
    "fronts": Material((0.60, 0.16, 0.08), GLOSS, 10), "top": Material((0.22, 0.21, 0.20), GLOSS, 10),
    "steel": Material(grey(0.25), grey(0.50), 20), "brass": Material((0.35, 0.24, 0.08), grey(0.35), 20),
    "black": Material(grey(0.05), grey(0.10), 20), "mirror": Material(grey(0.05), grey(0.75), 20),
    "porcelain": Material(grey(0.68), grey(0.12), 10), "sofa": Material((0.30, 0.36, 0.42)),
    "orange": Material((0.75, 0.36, 0.10)), "linen": Material((0.78, 0.76, 0.72)),
    "blue": Material((0.16, 0.26, 0.50)), "red": Material((0.60, 0.10, 0.08)),
    "green": Material((0.16, 0.36, 0.10)), "leaf": Material((0.14, 0.34, 0.09)),
    "yellow": Material((0.75, 0.60, 0.14)), "clay": Material((0.55, 0.26, 0.15)),
    "soil": Material((0.12, 0.08, 0.05)), "grass": Material((0.16, 0.30, 0.08)),
    "paving": Material((0.44, 0.41, 0.38)), "roof": Material((0.42, 0.15, 0.09)), "bark": Material((0.22, 0.14, 0.08)),
    "lamp": Material(grey(0.0), ke=(46.0, 39.0, 29.0)), "small_lamp": Material(grey(0.0), ke=(90.0, 74.0, 52.0)),
    "garden_lamp": Material(grey(0.0), ke=(24.0, 20.0, 14.0)),
    "screen": Material(grey(0.03), grey(0.10), 20),
}
BOOKS = ("red", "blue", "green", "sand", "walnut", "yellow", "linen")


class House:
    """The scene, and a source of chance for what should look arranged by hand."""

    def __init__(self):
        self.scene = Scene("House, metres", MATERIALS)
        self.random = random.Random(31000)

    def put(self, name, shape, x, z, turn=0, y=0.0):
        """Stands it on the floor below y (or on y), 2 mm clear."""
        self.scene.add(name, shape.turned(turn).moved(x, y + furniture.GAP, z))

    def hang(self, name, shape, x, z, y):
        self.scene.add(name, shape.moved(x, y, z))


def build_openings(house):
    for name, (room, axis, along, across, y, width, height, wall) in DOORS.items():
        turn = 90 if axis == "x" else 0
        x, z = (across, along) if axis == "x" else (along, across)
        house.put(name + "_frame", fittings.door_frame(width, height, wall, "paint"), x, z, turn, y - 0.002)
        if room is None:
            continue
        # Open: square to the wall, in the room on that side (+1, -1), hinged at that end.
        side, end = room
        leaf = fittings.door_leaf(width - 0.07, height, "oak", "brass")
        h, out = end * (width / 2 - 0.06), side * (wall / 2 + 0.03)
        if axis == "x":
            house.put(name + "_leaf", leaf.turned(0 if side > 0 else 180), x + out, z + h, 0, y)
        else:
            house.put(name + "_leaf", leaf.turned(-90 * side), x + h, z + out, 0, y)
    house.put("front_door_leaf", fittings.door_leaf(0.93, 2.1, "walnut", "brass"), 4.935, 0.15)
    for name, (axis, along, across, y, width, height, inward) in WINDOWS.items():
        frame = fittings.window_frame(width, height, 0.3, "paint")
        turn = {"x": 90, "z": 0}[axis] + (0 if inward > 0 else 180)
        x, z = (across, along) if axis == "x" else (along, across)
        house.put(name, frame, x, z, turn, y - 0.002)


def build_stairs(house):
    x0, z0, width, steps, rise, run = STAIRS
    house.put("stairs", fittings.stairs(width, steps, rise, run, "paint", "tread"), x0, z0)
    feet = [(0.05, (i + 1) * rise, (i + 0.5) * run) for i in range(steps)]
    house.put("stair_rail", fittings.railing(feet, 0.85, "oak", "steel"), x0, z0)
    well = [(0, 0, 0.2 * i) for i in range(16)]
    house.put("gallery_rail", fittings.railing(well, 0.9, "oak", "steel"), x0 - 0.12, 1.4, 0, UPPER)
    across = [(0.2 * i, 0, 0) for i in range(6)]
    house.put("gallery_rail_end", fittings.railing(across, 0.9, "oak", "steel"), x0 - 0.02, 1.28, 0, UPPER)


def build_lamps(house):
    for room, (x0, x1, z0, z1, y) in ROOMS.items():
        radius = 0.26 if (x1 - x0) * (z1 - z0) > 18 else 0.2
        house.hang(room + "_lamp", fittings.ceiling_lamp(radius, "paint", "lamp"),
                   (x0 + x1) / 2, (z0 + z1) / 2 - {"gallery": 1.3, "kitchen": 1.5}.get(room, 0), y + CEILING[y])


def set_table(house, name, x, z, y, seats):
    """Plates and cups before each seat (dx, dz)."""
    for i, (dx, dz) in enumerate(seats):
        house.put("%s_plate_%d" % (name, i), furniture.plate(0.13, "porcelain"), x + 0.65 * dx, z + 0.65 * dz, 0, y)
        house.put("%s_cup_%d" % (name, i), furniture.cup("blue"), x + 0.62 * dx + 0.19, z + 0.45 * dz, 40 * i, y)


def furnish_living(house):
    x, z = 2.75, 7.0
    house.put("living_rug", furniture.rug(2.8, 2.5, "red", "sand"), x, z)
    house.put("sofa", furniture.sofa(3, "sofa", "orange", "walnut"), x, z + 1.35, 180, 0.011)
    house.put("armchair", furniture.sofa(1, "orange", "linen", "walnut"), x + 2.0, z + 0.1, 280)
    house.put("sofa_table", furniture.table(1.1, 0.6, 0.42, "walnut"), x, z + 0.1, 0, 0.011)
    house.put("living_bowl", furniture.bowl(0.15, "clay"), x - 0.25, z + 0.12, 0, 0.433)
    house.put("living_fruit", furniture.fruit(5, 0.063, ("orange", "red", "yellow")), x - 0.25, z + 0.12, 0, 0.475)
    house.put("living_cup", furniture.cup("blue"), x + 0.3, z + 0.05, 30, 0.433)
    for i, dx in enumerate((0.0, 0.22, 0.25)):
        house.put("magazine_%d" % i, box(-0.105, 0.105, 0, 0.006, -0.14, 0.14, BOOKS[i]), x + 0.12 + 0.02 * i,
                  z + 0.22, 8 * i, 0.433 + 0.0085 * i)
    house.put("tv_bench", furniture.cupboard(1.7, 0.45, 0.42, 3, "oak", "steel"), 2.6, 5.15)
    house.put("tv", furniture.screen(1.15, "black", "screen"), 2.6, 5.12, 0, 0.452)
    for i, bx in enumerate((0.82, 3.98)):
        house.put("bookcase_%d" % i, furniture.bookcase(0.85, 2.0, 5, "oak", house.random, BOOKS), bx, 5.07)
    house.put("living_plant", furniture.plant(1.5, 22, house.random, "clay", "soil", "leaf"), 1.2, 8.85)
    house.put("living_plant_2", furniture.plant(1.0, 16, house.random, "porcelain", "soil", "leaf"), 5.45, 9.2)
    house.put("floor_lamp", fittings.floor_lamp(1.65, "steel", "linen", "small_lamp"), 4.6, 8.6)
    for i, wx in enumerate((1.95, 4.45)):
        house.put("living_curtain_%d" % i, furniture.curtain(0.5, 2.3, 6, "sand"), wx, 9.6, 180, 0.05)
    house.put("living_picture", furniture.picture(1.1, 0.75, "walnut", ("blue", "sky", "orange")), 5.997, 8.5, 270, 1.25)
    house.put("sideboard", furniture.cupboard(1.1, 0.85, 0.42, 2, "walnut", "brass"), 5.77, 5.45, 270)
    house.put("sideboard_vase", furniture.vase(0.38, "blue"), 5.77, 5.25, 0, 0.852)
    house.put("living_radiator", fittings.radiator(1.6, "paint"), 0.36, 7.3, 90)


def furnish_kitchen(house):
    # The run along the right wall, its back to x = 11.69, and one along the wall to the utility room.
    back, first = 11.69, 5.0
    run = [(0.6, "drawers"), (0.6, "oven"), (0.8, "doors"), (0.6, "drawers"), (0.8, "sink"), (0.6, "doors")]
    z, hole, places = first, None, {}
    for i, (width, kind) in enumerate(run):
        middle = z + width / 2
        places[kind + str(i)] = middle
        if kind == "oven":
            piece = fittings.oven(width - 0.004, "fronts", "black", "steel").moved(z=-0.29)
        elif kind == "sink":
            hole, piece = (middle - 0.25, middle + 0.25), sink_cupboard(width - 0.004)
        else:
            piece = furniture.cupboard(width - 0.004, 0.876, 0.56, 2 if kind == "doors" else 1, "fronts", "steel",
                                       3 if kind == "drawers" else 0)
        house.put("unit_%d" % i, piece, back - 0.3, middle, 270)
        z += width
    # A top along z: built along x, then turned so that its back lies at x = back.
    top = fittings.worktop(-z, -first, 0.62, [(-hole[1], -hole[0], 0.17, 0.53)], "top").turned(270)
    house.put("worktop", top, back, 0, 0)
    basin_z = (hole[0] + hole[1]) / 2
    house.put("sink", fittings.sink(0.5, 0.36, "steel").turned(270), back - 0.35, basin_z)
    house.put("kitchen_tap", fittings.tap(0.30, 0.18, "steel"), back - 0.115, basin_z, 270, 0.922)
    hob_z = places["oven1"]
    house.put("hob", fittings.hob(0.58, "black", "steel"), back - 0.31, hob_z, 270, 0.922)
    house.put("pot", fittings.pot(0.10, 0.13, "steel", "black"), back - 0.19, hob_z + 0.15, 20, 0.934)
    house.put("small_pot", fittings.pot(0.075, 0.09, "steel", "black"), back - 0.19, hob_z - 0.15, 70, 0.934)
    house.put("pan", fittings.pan(0.12, "black"), back - 0.43, hob_z - 0.15, 150, 0.934)
    house.put("hood", fittings.hood(0.6, "steel", "small_lamp"), back, hob_z, 270, 1.55)
    for i, (mz, width) in enumerate(((first + 0.29, 0.58), (hob_z + 0.62, 0.6))):
        wall_unit = furniture.cupboard(width, 0.72, 0.34, 1, "fronts", "steel")
        house.put("wall_unit_%d" % i, wall_unit, back - 0.18, mz, 270, 1.46)
    house.put("fridge", fittings.fridge("porcelain", "steel"), back - 0.33, z + 0.33, 270)
    for i, h in enumerate((0.30, 0.26, 0.32)):
        house.put("bottle_%d" % i, fittings.bottle(h, ("green", "clay", "green")[i]), back - 0.14 - 0.05 * (i % 2),
                  places["drawers3"] - 0.12 + 0.13 * i, 0, 0.922)
    house.put("kitchen_bowl", furniture.bowl(0.14, "yellow"), back - 0.35, places["doors2"] + 0.05, 0, 0.922)
    house.put("kitchen_herb", furniture.plant(0.34, 12, house.random, "clay", "soil", "leaf"),
              back - 0.25, places["doors5"] + 0.12, 0, 0.922)
    for i in range(3):
        house.put("stack_%d" % i, furniture.plate(0.12, "porcelain"), back - 0.28, first + 0.3, 0, 0.922 + 0.025 * i)
    x, z = 8.35, 7.35
    house.put("dining_table", furniture.table(1.9, 0.95, 0.74, "oak"), x, z)
    seats = [(-0.58, -0.45), (0.0, -0.45), (0.58, -0.45), (-0.58, 0.45), (0.0, 0.45), (0.58, 0.45)]
    for i, (dx, dz) in enumerate(seats):
        house.put("dining_chair_%d" % i, furniture.chair("oak", "sage"), x + dx, z + 1.62 * dz,
                  (180 if dz > 0 else 0) + (7 * i % 11 - 5))
    set_table(house, "dining", x, z, 0.742, [(1.45 * dx if dx else 0.001, dz) for dx, dz in seats])
    house.put("dining_vase", furniture.vase(0.26, "porcelain"), x, z, 0, 0.742)
    for i in (-1, 1):
        house.hang("pendant_%d" % (i > 0), fittings.pendant(0.95, 0.19, "orange", "small_lamp"), x + 0.5 * i, z, HEIGHT)
    house.put("kitchen_dresser", furniture.bookcase(1.2, 1.9, 4, "oak", house.random, BOOKS), 8.05, 5.07)
    for i, wx in enumerate((8.0, 10.4)):
        house.put("kitchen_curtain_%d" % i, furniture.curtain(0.36, 1.35, 4, "yellow"), wx, 9.6, 180, 1.0)
    house.put("kitchen_picture", furniture.picture(0.6, 0.8, "oak", ("yellow", "green", "red")), 6.153, 8.6, 90, 1.2)
    house.put("kitchen_plant", furniture.plant(1.2, 20, house.random, "clay", "soil", "leaf"), 6.95, 8.85)


def sink_cupboard(width):
    """Open above, so that the bowl hangs in it."""
    body = furniture.rectilinear([(-width / 2, width / 2, 0.06, 0.876, -0.28, 0.258)],
                                 [(-width / 2 + 0.02, width / 2 - 0.02, 0.08, 0.876, -0.26, 0.238)])
    fronts = furniture.joined(
        cushion(width / 2 - 0.006, 0.81, 0.019, 0.004, 1, "fronts").moved(s * width / 4, 0.063, 0.2695)
        + furniture.bar_handle((s * 0.05, 0.66, 0.281), (s * 0.05, 0.78, 0.281), "steel") for s in (-1, 1))
    return body.painted("fronts") + fronts


def furnish_hall(house):
    house.put("hall_rug", furniture.rug(1.3, 2.2, "blue", "sand"), 5.4, 2.4)
    house.put("hall_bench", furniture.table(1.1, 0.36, 0.45, "oak"), 4.16, 1.5, 90)
    house.put("hall_mirror", furniture.picture(0.6, 1.1, "brass", ("mirror", "mirror", "mirror")), 3.904, 1.5, 90, 0.95)
    house.put("wardrobe_rack", box(-0.5, 0.5, 0, 0.03, 0, 0.02, "oak"), 3.904, 4.15, 90, 1.7)
    for i in range(5):
        house.put("hook_%d" % i, tube([(0, 0, 0.001), (0, -0.01, 0.05), (0, 0.03, 0.07)], 0.006, 8, "steel"),
                  3.926, 3.75 + 0.2 * i, 90, 1.715)
    house.put("hall_plant", furniture.plant(1.1, 20, house.random, "porcelain", "soil", "leaf"), 6.4, 1.0)
    house.put("hall_picture", furniture.picture(0.5, 0.4, "walnut", ("sky", "sand", "green")), 5.885, 4.747, 180, 1.4)


def furnish_study(house):
    house.put("desk", furniture.table(1.5, 0.7, 0.74, "walnut"), 2.0, 0.72, 0)
    house.put("desk_screen", furniture.screen(0.6, "black", "screen"), 2.0, 0.56, 0, 0.742)
    house.put("desk_chair", furniture.chair("walnut", "blue"), 2.05, 1.35, 190)
    house.put("desk_lamp", fittings.floor_lamp(0.5, "brass", "linen", "small_lamp"), 1.45, 0.6, 0, 0.742)
    for i, x in enumerate((0.95,)):
        house.put("study_shelf_%d" % i, furniture.bookcase(1.0, 2.2, 6, "oak", house.random, BOOKS), x, 4.57, 180)
    house.put("study_rug", furniture.rug(1.6, 1.4, "green", "sand"), 2.0, 2.6)


def furnish_utility(house):
    house.put("utility_basin", fittings.basin("porcelain", "steel", "oak", "mirror"), 10.6, 0.57)
    house.put("utility_toilet", fittings.toilet("porcelain"), 9.3, 0.72)
    house.put("washing_machine", washing_machine(), 11.36, 3.9, 270)
    house.put("utility_cupboard", furniture.cupboard(0.9, 2.0, 0.4, 2, "paint", "steel"), 8.79, 2.6, 90)
    house.put("utility_rail", fittings.towel_rail("linen", "steel"), 11.69, 3.2, 270)


def washing_machine():
    body = cushion(0.6, 0.85, 0.58, 0.012, 1, "porcelain")
    door = lathe([(0, 0), (0.17, 0), (0.19, 0.02), (0.15, 0.035), (0, 0.02)], 28, "black").turned(90, "x")
    return body + door.moved(0, 0.45, 0.292)


def furnish_bedrooms(house):
    y = UPPER
    house.put("double_bed", furniture.bed(1.6, "walnut", "linen", "blue"), 1.5, 1.9, 90, y)
    for i, z in enumerate((0.78, 3.02)):
        house.put("night_table_%d" % i, furniture.cupboard(0.42, 0.48, 0.38, 1, "walnut", "brass", 2), 0.53, z, 90, y)
        house.put("night_lamp_%d" % i, fittings.floor_lamp(0.42, "brass", "linen", "small_lamp"), 0.53, z, 0, y + 0.482)
    house.put("wardrobe", furniture.cupboard(1.7, 2.1, 0.6, 4, "paint", "brass"), 1.3, 5.77, 180, y)
    house.put("parents_rug", furniture.rug(1.0, 2.2, "sand", "rose"), 3.12, 2.2, 0, y)
    house.put("child_bed", furniture.bed(0.95, "oak", "linen", "yellow"), 11.1, 1.5, 0, y)
    house.put("child_desk", furniture.table(1.1, 0.6, 0.72, "oak"), 9.2, 0.72, 0, y)
    house.put("child_chair", furniture.chair("oak", "red"), 9.2, 1.3, 175, y)
    house.put("child_shelf", furniture.bookcase(0.9, 1.4, 4, "paint", house.random, BOOKS), 11.52, 5.0, 270, y)
    house.put("child_rug", furniture.rug(1.8, 1.6, "sky", "yellow"), 10.0, 3.7, 0, y)
    for i in range(5):
        house.put("brick_%d" % i, box(-0.06, 0.06, 0, 0.12, -0.06, 0.06, BOOKS[i]), 9.7 + 0.17 * i,
                  3.6 + 0.12 * (i % 3), 25 * i, y + 0.011)
    house.put("guest_bed", furniture.bed(1.4, "oak", "linen", "green"), 1.5, 8.0, 90, y)
    house.put("guest_chest", furniture.cupboard(1.0, 0.9, 0.45, 1, "oak", "brass", 4), 4.6, 9.46, 180, y)
    house.put("guest_vase", furniture.vase(0.3, "clay"), 4.5, 9.46, 0, y + 0.902)
    house.put("guest_chair", furniture.chair("oak", "sage"), 5.15, 8.3, 250, y)
    house.put("guest_picture", furniture.picture(0.9, 0.6, "oak", ("green", "sky", "linen")), 5.997, 7.2, 270, y + 1.3)
    house.put("gallery_plant", furniture.plant(1.2, 24, house.random, "clay", "soil", "leaf"), 4.75, 1.1, 0, y)
    house.put("gallery_bench", furniture.table(1.2, 0.4, 0.45, "oak"), 4.2, 3.2, 90, y)
    for i, (x, colour) in enumerate(((0.95, "blue"), (3.05, "blue"))):
        house.put("parents_curtain_%d" % i, furniture.curtain(0.4, 1.6, 4, colour), x, 0.42, 0, y + 0.7)


def furnish_bath(house):
    y = UPPER
    house.put("bath_tub", fittings.bath_tub("porcelain", "steel"), 10.6, 8.9, 0, y)
    house.put("bath_tap", fittings.tap(0.85, 0.16, "steel"), 10.6, 9.58, 180, y)
    for i, x in enumerate((7.0, 7.9)):
        house.put("basin_%d" % i, fittings.basin("porcelain", "steel", "oak", "mirror"), x, 9.43, 180, y)
    house.put("bath_toilet", fittings.toilet("porcelain"), 11.28, 7.2, 270, y)
    house.put("bath_rail", fittings.towel_rail("linen", "steel"), 6.153, 8.0, 90, y)
    house.put("bath_mat", furniture.rug(1.2, 0.7, "sky", "linen"), 10.4, 7.9, 0, y)
    house.put("bath_cupboard", furniture.cupboard(0.8, 1.8, 0.4, 2, "paint", "steel"), 9.4, 6.47, 0, y)


def build_roof(house):
    """Two slopes of lapped boards over a closed gable."""
    (x0, x1, z0, z1), base, over, rise = PLAN, UPPER + HEIGHT + 0.1, 0.5, 3.2
    ridge = (z0 + z1) / 2
    gable = [(-z1 + 0.01, 0), (-z0 - 0.01, 0), (-ridge, rise)]
    attic = Shape([(x, base + furniture.GAP + h, -u) for x in (x0, x1) for u, h in gable],
                  [(f, "plaster") for f in ([0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5])])
    house.scene.add("attic", attic if attic.volume() > 0 else flipped(attic))
    rows, columns = 11, 8
    run = ridge - z0 + over
    slope = rise / (ridge - z0)
    width = (x1 - x0 + 2 * over) / columns
    for side in (0, 1):
        boards = []
        for i in range(rows):
            t0, t1 = run * i / rows, run * (i + 1.12) / rows
            z_low, z_high = z0 - over + t0, min(z0 - over + t1, ridge - 0.01)
            low, high = 0.05 + slope * (z_low - z0), 0.015 + 0.012 + slope * (z_high - z0)
            for j in range(columns):
                a = x0 - over + j * width + 0.002
                b = a + width - 0.004
                tile = Shape([(x, base + y, z) for x in (a, b) for z, y in
                              ((z_low, low), (z_high, high), (z_high, high + 0.018), (z_low, low + 0.018))],
                             [(f, "roof") for f in ([0, 1, 2, 3], [7, 6, 5, 4], [0, 4, 5, 1], [1, 5, 6, 2],
                                                    [2, 6, 7, 3], [3, 7, 4, 0])])
                tile = tile if tile.volume() > 0 else flipped(tile)
                boards.append(tile.turned(180).moved(x0 + x1, 0, z0 + z1) if side else tile)
        house.scene.add("roof_%d" % side, furniture.joined(boards))
    cap = tube([(x0 - over, base + rise + 0.11, ridge), (x1 + over, base + rise + 0.11, ridge)], 0.07, 12, "roof")
    house.scene.add("ridge", cap)


def flipped(shape):
    return Shape(shape.vertices, [(corners[::-1], m) for corners, m in shape.faces])


def tree(height, random_source, leaves):
    """A trunk, branches, and leaves at their ends."""
    parts = [tube([(0, 0, 0), (0, 0.05 * height, 0), (0.05, 0.3 * height, 0.03), (0, 0.62 * height, 0)],
                  [0.055 * height / 2, 0.05 * height / 2, 0.04 * height / 2, 0.022 * height / 2], 10, "bark")]
    for i in range(leaves):
        y = height * (0.36 + 0.6 * i / leaves)
        reach = height * 0.34 * math.sin(math.pi * (i / leaves * 0.9 + 0.1))
        blade = furniture.leaf(reach * (0.55 + 0.4 * random_source.random()), 0.45 * reach + 0.15,
                               0.5 * reach * random_source.random(), 0.5 * reach, "leaf")
        parts.append(blade.moved(z=0.09 + 0.12 * random_source.random()).turned(137.5 * i).moved(y=y))
    return furniture.joined(parts)


def build_garden(house):
    x0, x1, z0, z1 = GARDEN
    house.scene.add("ground", furniture.rectilinear([(x0, x1, -0.6, -0.202, z0, z1)], (), 3.0).painted("grass"))
    cells = [(5.0 + 0.47 * (i % 2) - 0.05, -0.80 - 0.55 * j) for j in range(6) for i in (0, 1)]
    for i, (x, z) in enumerate(cells):
        house.put("paving_%d" % i, box(-0.22, 0.22, 0, 0.04, -0.26, 0.26, "paving"), x + 0.22, z, 0, -0.202)
    house.put("door_step", box(-0.7, 0.7, 0, 0.19, -0.22, 0.22, "concrete"), 5.4, -0.24, 0, -0.202)
    house.put("terrace", furniture.rectilinear([(0.8, 6.8, 0, 0.15, 10.02, 13.0)], (), 1.0).painted("paving"), 0, 0, 0, -0.202)
    house.put("garden_table", furniture.table(1.3, 0.8, 0.72, "oak"), 3.4, 11.5, 0, -0.05)
    for i, (dx, dz) in enumerate(((0.0, -0.8), (0.0, 0.8))):
        house.put("garden_chair_%d" % i, furniture.chair("oak", "linen"), 3.4 + dx, 11.5 + dz, 180 if dz > 0 else 0, -0.05)
    for i, (x, z, h) in enumerate(((-2.6, 3.0, 5.0), (14.6, -1.2, 4.4), (14.4, 12.6, 5.4))):
        house.put("tree_%d" % i, tree(h, house.random, 16), x, z, 33 * i, -0.202)
    for i, x in enumerate((1.9, 10.1)):
        house.put("bush_%d" % i, furniture.plant(0.8, 12, house.random, "clay", "soil", "leaf"), x, -0.7, 50 * i, -0.202)
    for i, (x, z) in enumerate(((4.5, -1.6), (6.3, -1.6), (4.5, -3.4), (6.3, -3.4))):
        house.put("garden_lamp_%d" % i, garden_lamp(), x, z, 0, -0.202)
    porch = box(-0.08, 0.08, 0, 0.2, 0.002, 0.10, "black").painted_by(
        lambda normal, middle: "garden_lamp" if normal[1] < -0.9 else None)
    for i, x in enumerate((4.5, 6.3)):
        house.put("porch_lamp_%d" % i, porch, x, 0, 180, 1.9)


def garden_lamp():
    post = cylinder(0.04, 0, 0.7, 10, "black")
    light = box(-0.05, 0.05, 0.702, 0.82, -0.05, 0.05, "black").painted_by(
        lambda normal, middle: "garden_lamp" if abs(normal[1]) < 0.5 else None)
    return post + light + cushion(0.18, 0.02, 0.18, 0.005, 1, "black").moved(y=0.822)


def make_house():
    house = House()
    house.scene.add("shell", shell())
    for build in (build_openings, build_stairs, build_lamps, furnish_living, furnish_kitchen, furnish_hall,
                  furnish_study, furnish_utility, furnish_bedrooms, furnish_bath, build_roof, build_garden):
        build(house)
    cameras = {
        "living": ((0.7, 1.6, 5.6), (4.2, 0.9, 8.6), 60), "kitchen": ((6.5, 1.65, 5.4), (10.4, 0.95, 7.6), 60),
        "hall": ((4.3, 1.6, 4.4), (6.6, 1.3, 1.2), 65), "outside": ((-3.5, 2.6, -12.0), (6.3, 3.6, 2.0), 48),
        "bedroom": ((3.4, UPPER + 1.6, 5.2), (1.2, UPPER + 0.6, 1.6), 65),
        "bath": ((8.2, UPPER + 1.6, 6.5), (9.6, UPPER + 0.6, 9.2), 70),
    }
    for name, (eye, look_at, fov) in cameras.items():
        house.scene.add_camera(name, eye, look_at, fov)
    return house.scene


def write_walk(path):
    lines = ["# time [s], eye, look-at, up, vertical field of view [degrees]; straight between key frames"]
    for time, eye, look_at in WALK:
        lines.append(" ".join("%g" % v for v in (time, *eye, *look_at, 0, 1, 0, 60)))
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def main():
    arguments = parse_arguments(__doc__)
    folder = Path(arguments.folder)
    write_scene(make_house(), folder / "house.obj")
    write_walk(folder / "house.path")


if __name__ == "__main__":
    main()
