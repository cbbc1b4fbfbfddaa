"""Furniture for house.py, in metres. Each piece stands on y = 0 about the origin and faces +z; parts
that would touch keep GAP apart, so that no two faces coincide.
"""
import math

from mesh import Shape, ball, box, cos_sin, cushion, cylinder, lathe, rectilinear, tube

GAP = 0.002


def joined(parts):
    total = Shape()
    for part in parts:
        total = total + part
    return total


def legs(width, depth, height, radius, material):
    """Turned legs at the corners."""
    profile = [(radius * r, height * y) for r, y in
               ((0.6, 0), (0.75, 0.1), (1, 0.5), (0.8, 0.74), (1.1, 0.8), (1, 1))]
    leg = lathe(profile, 6, material)
    return joined(leg.moved(sx * (width / 2 - radius * 1.5), 0, sz * (depth / 2 - radius * 1.5))
                  for sx in (-1, 1) for sz in (-1, 1))


def table(width, depth, height, material):
    top = cushion(width, 0.035, depth, 0.012, 1, material).moved(y=height - 0.035)
    apron = rectilinear([(-width / 2 + 0.1, width / 2 - 0.1, height - 0.12, height - 0.035 - GAP,
                          -depth / 2 + 0.1, depth / 2 - 0.1)],
                        [(-width / 2 + 0.12, width / 2 - 0.12, height - 0.12, height - 0.035 - GAP,
                          -depth / 2 + 0.12, depth / 2 - 0.12)]).painted(material)
    return top + apron + legs(width, depth, height - 0.035 - GAP, 0.03, material)


def chair(wood, cloth):
    parts = [legs(0.42, 0.42, 0.43, 0.02, wood),
             box(-0.215, 0.215, 0.43 + GAP, 0.46, -0.215, 0.215, wood),
             cushion(0.40, 0.045, 0.36, 0.02, 1, cloth, flat=2, bulge=0.2).moved(0, 0.470, 0.025)]
    for x in (-0.19, 0.19):
        parts.append(tube([(x, 0.464, -0.212), (x, 0.70, -0.22), (x, 0.93, -0.27)], 0.013, 6, wood))
    for y, lean in ((0.62, 0.217), (0.72, 0.225), (0.82, 0.245)):
        parts.append(box(-0.175, 0.175, y, y + 0.06, -0.008 - lean, 0.008 - lean, wood))
    return joined(parts)


def sofa(seats, cloth, accent, wood):
    width = 0.62 * seats + 0.36
    parts = [box(-width / 2 + 0.05, width / 2 - 0.05, 0.10, 0.22, -0.40, 0.40, cloth),
             cushion(width - 0.37, 0.48, 0.20, 0.05, 1, cloth).moved(0, 0.222, -0.31)]
    parts += [cushion(0.18, 0.40, 0.84, 0.06, 1, cloth).moved(s * (width / 2 - 0.09), 0.222, 0)
              for s in (-1, 1)]
    for i in range(seats):
        x = 0.62 * (i - (seats - 1) / 2)
        parts.append(cushion(0.61, 0.19, 0.60, 0.06, 2, cloth, 2, 0.12).moved(x, 0.236, 0.105))
        parts.append(cushion(0.58, 0.40, 0.13, 0.05, 2, cloth, 2, 0.25)
                     .turned(-8, "x").moved(x, 0.455, -0.045))
    parts.append(cushion(0.36, 0.34, 0.12, 0.05, 1, accent, 3, 0.3)
                 .turned(-22, "x").moved(width / 2 - 0.50, 0.475, 0.22))
    parts.append(joined(cylinder(0.025, 0, 0.098, 8, wood).moved(sx * (width / 2 - 0.12), 0, sz * 0.33)
                        for sx in (-1, 1) for sz in (-1, 1)))
    return joined(parts)


def bed(width, wood, linen, blanket):
    length = 2.0
    parts = [box(-width / 2, width / 2, 0.12, 0.30, -length / 2, length / 2, wood),
             cushion(width + 0.08, 1.0, 0.05, 0.02, 1, wood).moved(0, 0.12, -length / 2 - 0.03),
             cushion(width - 0.04, 0.20, length - 0.04, 0.06, 1, linen, 2).moved(y=0.302),
             cushion(width + 0.04, 0.10, 1.36, 0.045, 2, blanket, 3).moved(0, 0.505, 0.30),
             joined(box(sx * (width / 2 - 0.06) - 0.03, sx * (width / 2 - 0.06) + 0.03, 0, 0.118,
                        sz * 0.93 - 0.03, sz * 0.93 + 0.03, wood)
                    for sx in (-1, 1) for sz in (-1, 1))]
    pillows = 2 if width > 1.2 else 1
    for i in range(pillows):
        x = (i - (pillows - 1) / 2) * 0.78
        parts.append(cushion(0.68, 0.14, 0.42, 0.06, 1, linen, 3, 0.25)
                     .turned(8, "x").moved(x, 0.56, -0.68))
    return joined(parts)


def books(width, height, depth, random, materials):
    """A row from -width/2, leaving the last part of the shelf empty."""
    parts, x = [], -width / 2 + 0.01
    end = width / 2 - width * 0.3 * random.random() - 0.05
    while x < end:
        thick = 0.030 + 0.05 * random.random()
        tall = height * (0.68 + 0.24 * random.random())
        deep = depth * (0.66 + 0.2 * random.random())
        parts.append(box(x, x + thick, 0, tall, -depth / 2, deep - depth / 2,
                         materials[int(random.random() * len(materials))]))
        x += thick + 0.0015
    return joined(parts)


def bookcase(width, height, shelves, wood, random, materials):
    depth, board = 0.30, 0.022
    bay = (height - 0.06 - board) / shelves
    holes = [(-width / 2 + board, width / 2 - board, 0.06 + board + i * bay, 0.06 + (i + 1) * bay,
              -depth / 2 + 0.008, depth / 2) for i in range(shelves)]
    case = rectilinear([(-width / 2, width / 2, 0, height, -depth / 2, depth / 2)], holes).painted(wood)
    rows = joined(books(width - 2 * board, bay - board, depth - 0.02, random, materials)
                  .moved(0, hole[2] + GAP, 0.01) for hole in holes)
    return case + rows


def cupboard(width, height, depth, doors, material, handle, drawers=0):
    """A body with doors, or with drawers above one another."""
    body = box(-width / 2, width / 2, 0.06, height, -depth / 2, depth / 2 - 0.022, material)
    plinth = box(-width / 2 + 0.02, width / 2 - 0.02, 0, 0.058, -depth / 2, depth / 2 - 0.06, material)
    parts, front = [body, plinth], depth / 2 - 0.020
    columns, rows = (1, drawers) if drawers else (doors, 1)
    w, h = width / columns, (height - 0.06) / rows
    for i in range(columns):
        for j in range(rows):
            x, y = -width / 2 + (i + 0.5) * w, 0.06 + j * h
            parts.append(box(x - w / 2 + 0.003, x + w / 2 - 0.003, y + 0.003, y + h - 0.003,
                             front, front + 0.019, material))
            z = front + 0.021
            if drawers:
                parts.append(bar_handle((x - 0.06, y + h / 2, z), (x + 0.06, y + h / 2, z), handle))
            else:
                side = x + (w / 2 - 0.05) * (-1 if i % 2 else 1)
                middle = y + (0.5 if height > 1.2 else 0.8) * h
                parts.append(bar_handle((side, middle - 0.06, z), (side, middle + 0.06, z), handle))
    return joined(parts)


def bar_handle(a, b, material):
    """A bow from a to b, towards +z."""
    def on(t, out):
        return (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + out)
    return tube([on(0, 0), on(0.08, 0.028), on(0.92, 0.028), on(1, 0)], 0.005, 5, material)


def leaf(length, width, rise, droop, material):
    """A blade from the origin towards +z, closed and thin: a lens across, pointed at its ends."""
    steps, thick = 4, 0.0015
    shape, rings = Shape(), []
    for i in range(steps + 1):
        t = i / steps
        y, z = rise * t - droop * t * t, length * t
        half = 0.0 if i in (0, steps) else width / 2 * math.sin(math.pi * t ** 0.8)
        points = [(0, y, z)] if half == 0 else [
            (-half, y + 0.3 * half, z), (0, y - thick, z), (half, y + 0.3 * half, z), (0, y + thick, z)]
        rings.append(range(len(shape.vertices), len(shape.vertices) + len(points)))
        shape.vertices += points
    for a, b in zip(rings, rings[1:]):
        for k in range(4):
            corners = [a[k % len(a)], a[(k + 1) % 4 % len(a)], b[(k + 1) % 4 % len(b)], b[k % len(b)]]
            corners = [c for i, c in enumerate(corners) if c != corners[i - 1]]
            shape.faces.append((corners, material))
    return shape


def plant(height, leaves, random, pot, soil, green):
    """A pot with a stem and leaves around it."""
    radius = 0.09 + 0.07 * height
    vessel = lathe([(0, 0), (0.7 * radius, 0), (radius, 1.6 * radius), (1.08 * radius, 1.65 * radius),
                    (1.08 * radius, 1.85 * radius), (0.95 * radius, 1.85 * radius),
                    (0.9 * radius, 1.55 * radius), (0, 1.55 * radius)], 14, pot)
    earth = cylinder(0.86 * radius, 1.56 * radius + GAP, 1.7 * radius, 14, soil)
    parts = [vessel, earth]
    base = 1.7 * radius + GAP
    stem = base + 0.55 * (height - base)
    parts.append(tube([(0, base, 0), (0.008, (base + stem) / 2, 0), (0, stem, 0)], 0.010, 6, green))
    for i in range(leaves):
        length = (0.28 + 0.2 * random.random()) * height * 0.9
        blade = leaf(length, 0.32 * length, length * (0.35 + 0.9 * random.random()), 0.5 * length, green)
        y = base + 0.06 + (stem - base - 0.05) * i / leaves
        parts.append(blade.moved(z=0.022).turned(137.5 * i).moved(y=y))
    return joined(parts)


def vase(height, material):
    points = [(0, 0), (0.20, 0), (0.30, 0.14), (0.34, 0.34), (0.26, 0.6), (0.13, 0.8), (0.13, 0.9),
              (0.19, 1.0), (0.165, 1.0), (0.105, 0.9), (0.105, 0.8), (0.22, 0.6), (0.30, 0.34),
              (0.25, 0.10), (0, 0.08)]
    return lathe([(r * height, y * height) for r, y in points], 18, material)


def bowl(radius, material):
    arc = [cos_sin(a) for a in range(20, 91, 14)]
    outside = [(0, 0), (0.4 * radius, 0)] + [(radius * s, 0.5 * radius * (1 - c) + 0.01) for c, s in arc]
    inside = [(0.93 * radius * s, 0.47 * radius * (1 - c) + 0.025) for c, s in reversed(arc)]
    return lathe(outside + inside + [(0, 0.02)], 18, material)


def plate(radius, material):
    return lathe([(0, 0), (0.6 * radius, 0), (radius, 0.018), (radius, 0.022), (0.62 * radius, 0.006),
                  (0, 0.006)], 14, material)


def cup(material):
    body = lathe([(0, 0), (0.026, 0), (0.036, 0.03), (0.04, 0.085), (0.036, 0.085), (0.032, 0.03),
                  (0.02, 0.008), (0, 0.008)], 12, material)
    ear = tube([(0.0405 + 0.022 * s, 0.05 + 0.024 * c, 0) for c, s in
                (cos_sin(a) for a in range(20, 161, 35))], 0.004, 4, material)
    return body + ear.moved(x=0.002)


def fruit(count, radius, materials):
    return joined(ball(0.035, 6, 8, materials[k % len(materials)])
                  .moved(radius * cos_sin(360 * k / count)[0], 0.037, radius * cos_sin(360 * k / count)[1])
                  for k in range(count))


def picture(width, height, frame, canvas):
    """Its back is at z = 0, its lower edge at y = 0."""
    f = 0.035
    border = rectilinear([(-width / 2, width / 2, 0, height, 0, 0.025)],
                         [(-width / 2 + f, width / 2 - f, f, height - f, 0.010, 0.025)]).painted(frame)
    rows = joined(box(-width / 2 + f + GAP, width / 2 - f - GAP,
                      f + GAP + i * (height - 2 * f - GAP) / 3,
                      f + (i + 1) * (height - 2 * f - GAP) / 3, 0.010 + GAP, 0.016, m)
                  for i, m in enumerate(canvas))
    return border + rows


def screen(width, case, glass):
    height = 0.58 * width
    body = cushion(width, height, 0.04, 0.01, 1, case).moved(y=0.08)
    front = box(-width / 2 + 0.02, width / 2 - 0.02, 0.10, height + 0.06, 0.02 + GAP, 0.026, glass)
    foot = cushion(0.4 * width, 0.015, 0.2, 0.005, 1, case)
    return joined([body, front, foot, box(-0.05, 0.05, 0.017, 0.078, -0.015, 0.015, case)])


def rug(width, depth, material, border):
    return (rectilinear([(-width / 2, width / 2, 0, 0.010, -depth / 2, depth / 2)],
                        [(-width / 2 + 0.15, width / 2 - 0.15, 0, 0.010, -depth / 2 + 0.15, depth / 2 - 0.15)],
                        0.6).painted(border)
            + rectilinear([(-width / 2 + 0.152, width / 2 - 0.152, 0, 0.010,
                            -depth / 2 + 0.152, depth / 2 - 0.152)]).painted(material))


def curtain(width, height, folds, material):
    """Hangs from y = height down to 0 in waves along x."""
    n, amplitude, thick = folds * 4, 0.035, 0.004

    def line(z):
        return [(width * (i / n - 0.5), z + amplitude * math.sin(2 * math.pi * i * folds / n))
                for i in range(n + 1)]
    # One quadrilateral a step, also above and below, where a single face would be far from convex.
    shape = Shape([(x, y, z) for y in (0, height) for side in (thick, -thick) for x, z in line(side)])
    m = n + 1
    front, back, above = 0, m, 2 * m
    for i in range(n):
        a, b, c, d = front + i, front + i + 1, back + i + 1, back + i
        shape.faces += [([a, b, above + b, above + a], material), ([c, d, above + d, above + c], material),
                        ([d, c, b, a], material), ([above + a, above + b, above + c, above + d], material)]
    ends = [[back, front, above + front, above + back],
            [front + n, back + n, above + back + n, above + front + n]]
    shape.faces += [(e, material) for e in ends]
    return shape
