"""The plan of house.py's house, in metres: y is up, the street lies at negative z."""
from mesh import rectilinear

PLAN = (0.0, 12.0, 0.0, 10.0)  # x, z
GARDEN = (-6.0, 18.0, -8.0, 16.0)
HEIGHT = 2.6                   # of the rooms below
UPPER = 2.85                   # of the upper floor
CEILING = {0.0: HEIGHT, UPPER: 2.5}

# x0, x1, z0, z1, floor
ROOMS = {
    "study": (0.3, 3.75, 0.3, 4.75, 0.0), "hall": (3.9, 8.4, 0.3, 4.75, 0.0),
    "utility": (8.55, 11.7, 0.3, 4.75, 0.0), "living": (0.3, 6.0, 4.9, 9.7, 0.0),
    "kitchen": (6.15, 11.7, 4.9, 9.7, 0.0), "parents": (0.3, 3.75, 0.3, 6.1, UPPER),
    "gallery": (3.9, 8.4, 0.3, 6.1, UPPER), "child": (8.55, 11.7, 0.3, 6.1, UPPER),
    "guest": (0.3, 6.0, 6.25, 9.7, UPPER), "bath": (6.15, 11.7, 6.25, 9.7, UPPER),
}
# floor, walls
FINISH = {
    "study": ("parquet", "sage"), "hall": ("tiles", "warm_white"), "utility": ("tiles", "wall_tiles"),
    "living": ("parquet", "warm_white"), "kitchen": ("tiles", "sand"), "parents": ("parquet", "rose"),
    "gallery": ("parquet", "warm_white"), "child": ("parquet", "sky"), "guest": ("parquet", "sand"),
    "bath": ("tiles", "wall_tiles"),
}

# x0, z0 of the first step, width, steps, rise, run
STAIRS = (7.36, 0.9, 1.02, 15, UPPER / 16, 0.25)
WELL = (7.3, 8.4, 1.4, 4.65)

# name: (open leaf as (side, hinge's end) or None, axis across the wall, along, across, floor, width, height,
# wall's thickness)
DOORS = {
    "front_door": (None, "z", 5.4, 0.15, 0.0, 1.0, 2.1, 0.3),
    "terrace_door": (None, "z", 3.2, 9.85, 0.0, 2.0, 2.2, 0.3),
    "living_door": ((1, 1), "z", 5.0, 4.825, 0.0, 1.0, 2.1, 0.15),
    "kitchen_door": ((1, -1), "z", 6.75, 4.825, 0.0, 0.96, 2.1, 0.15),
    "passage": (None, "x", 6.6, 6.075, 0.0, 1.4, 2.2, 0.15),
    "study_door": ((-1, 1), "x", 3.05, 3.825, 0.0, 0.9, 2.1, 0.15),
    "utility_door": ((-1, 1), "z", 9.45, 4.825, 0.0, 0.9, 2.1, 0.15),
    "parents_door": ((-1, 1), "x", 5.45, 3.825, UPPER, 0.9, 2.05, 0.15),
    "child_door": ((1, 1), "x", 5.45, 8.475, UPPER, 0.9, 2.05, 0.15),
    "guest_door": ((1, 1), "z", 4.65, 6.175, UPPER, 0.9, 2.05, 0.15),
    "bath_door": ((1, -1), "z", 7.05, 6.175, UPPER, 0.9, 2.05, 0.15),
}

# name: (axis across the wall, along, across, sill, width, height, inward sense of that axis)
WINDOWS = {
    "study_window": ("z", 2.0, 0.15, 0.95, 1.6, 1.25, 1), "study_side_window": ("x", 2.4, 0.15, 0.95, 1.6, 1.25, 1),
    "hall_window": ("z", 6.85, 0.15, 0.95, 0.6, 1.25, 1), "living_window": ("x", 7.3, 0.15, 0.75, 2.2, 1.45, 1),
    "kitchen_window": ("z", 9.2, 9.85, 1.1, 2.0, 1.1, -1), "kitchen_side_window": ("x", 7.55, 11.85, 1.1, 1.2, 1.1, -1),
    "utility_window": ("x", 2.3, 11.85, 1.35, 0.9, 0.85, -1),
    "parents_window": ("z", 2.0, 0.15, UPPER + 0.9, 1.6, 1.2, 1),
    "parents_side_window": ("x", 4.6, 0.15, UPPER + 0.9, 1.4, 1.2, 1),
    "gallery_window": ("z", 5.8, 0.15, UPPER + 0.9, 1.4, 1.2, 1),
    "child_window": ("z", 10.1, 0.15, UPPER + 0.9, 1.5, 1.2, 1),
    "child_side_window": ("x", 3.0, 11.85, UPPER + 0.9, 1.5, 1.2, -1),
    "guest_window": ("z", 2.6, 9.85, UPPER + 0.9, 1.8, 1.2, -1),
    "bath_window": ("z", 9.2, 9.85, UPPER + 1.3, 1.1, 0.8, -1),
}

# time, eye, look-at: living room, hall, kitchen
WALK = [
    (0.0, (0.75, 1.6, 5.75), (3.6, 1.0, 8.6)),
    (3.0, (1.1, 1.6, 6.0), (4.6, 1.2, 7.6)),
    (6.0, (4.75, 1.6, 6.1), (5.4, 1.3, 3.0)),
    (8.0, (4.9, 1.6, 5.2), (5.6, 1.4, 2.0)),
    (10.0, (4.95, 1.6, 4.1), (6.9, 1.4, 2.0)),
    (12.0, (5.6, 1.6, 3.7), (7.2, 1.4, 4.4)),
    (14.0, (6.75, 1.6, 4.1), (7.0, 1.3, 6.6)),
    (16.0, (6.8, 1.6, 5.4), (9.4, 1.1, 7.2)),
    (19.0, (6.85, 1.6, 6.1), (10.6, 1.0, 7.0)),
    (22.0, (9.6, 1.6, 6.15), (11.2, 1.0, 6.2)),
]


def shell():
    """Walls and floors: a block less its rooms and openings, painted by what they face."""
    x0, x1, z0, z1 = PLAN
    roof = UPPER + CEILING[UPPER] + 0.2
    holes = [(a, b, y, y + CEILING[y], c, d) for a, b, c, d, y in ROOMS.values()]
    holes.append((WELL[0], WELL[1], HEIGHT, UPPER, WELL[2], WELL[3]))
    for _, axis, along, across, y, width, height, wall in DOORS.values():
        holes.append(opening(axis, along, across, y, width, height, wall))
    for axis, along, across, y, width, height, _ in WINDOWS.values():
        holes.append(opening(axis, along, across, y, width, height, 0.3))
    block = rectilinear([(x0, x1, -0.2, roof, z0, z1)], [tuple(round(v, 6) for v in h) for h in holes], 1.5)
    return block.painted_by(finish)


def opening(axis, along, across, y, width, height, wall):
    a, b, c, d = along - width / 2, along + width / 2, across - wall / 2, across + wall / 2
    return (c, d, y, y + height, a, b) if axis == "x" else (a, b, y, y + height, c, d)


def finish(normal, middle):
    p = [m + 0.01 * n for m, n in zip(middle, normal)]
    for name, (a, b, c, d, y) in ROOMS.items():
        if a <= p[0] <= b and c <= p[2] <= d and y <= p[1] <= y + CEILING[y]:
            floor, wall = FINISH[name]
            return floor if normal[1] > 0.5 else "ceiling" if normal[1] < -0.5 else wall
    inside = PLAN[0] < p[0] < PLAN[1] and PLAN[2] < p[2] < PLAN[3]
    if inside and 0 < p[1] < UPPER + HEIGHT:
        return "parquet" if normal[1] > 0.5 and abs(p[1] - UPPER) < 0.1 or p[1] < 0.1 else "paint"
    return "plaster"
