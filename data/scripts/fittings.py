"""What is built into a house: openings, stairs, lamps, kitchen and bath, in metres, for house.py.

As in furniture.py each piece stands on y = 0 about the origin and faces +z, and parts keep GAP apart.
"""
import math

from furniture import GAP, bar_handle, joined
from mesh import Shape, ball, box, cushion, cylinder, lathe, rectilinear, tube


def door_frame(width, height, wall, material):
    """Lining and architraves of an opening in a wall of that thickness about z = 0."""
    g, t, out, over = 0.003, wall / 2, 0.016, 0.06
    solids = [(s * width / 2 - (0.03 if s > 0 else -g), s * width / 2 + (0.03 if s < 0 else -g),
               g, height - g, -t - out, t + out) for s in (-1, 1)]
    solids.append((-width / 2 + g, width / 2 - g, height - 0.03, height - g, -t - out, t + out))
    for z0, z1 in ((-t - out, -t - g), (t + g, t + out)):
        for s in (-1, 1):
            x = sorted((s * (width / 2 - 0.03), s * (width / 2 + over)))
            solids.append((x[0], x[1], g, height + over, z0, z1))
        solids.append((-width / 2 - over, width / 2 + over, height - 0.03, height + over, z0, z1))
    return rectilinear(solids).painted(material)


def door_leaf(width, height, material, handle):
    """Its hinge stands at the origin; the leaf runs along +x, 40 mm thick, with panels."""
    x0, x1, t = 0.004, width - 0.004, 0.02
    panels = [(x0 + 0.12, x1 - 0.12, y0, y1, z, z + 0.006)
              for y0, y1 in ((0.15, 0.85), (1.0, height - 0.15)) for z in (-t, t - 0.006)]
    leaf = rectilinear([(x0, x1, 0.008, height - 0.036, -t, t)], panels).painted(material)
    knobs = joined(bar_handle((x1 - 0.06, 0.98, 0), (x1 - 0.16, 0.98, 0), handle)
                   .turned(turn).moved(x=(x1 + x1 - 0.22) * (turn == 180), z=shift)
                   for turn, shift in ((0, t + 0.008), (180, -t - 0.008)))
    return leaf + knobs


def window_frame(width, height, wall, material):
    """Set into an opening of that size that begins at y = 0: a frame with a cross, and a sill."""
    g, f, t = 0.004, 0.06, 0.03
    columns = 2 if width > 0.8 else 1
    w = (width - 2 * g - f * (columns + 1)) / columns
    panes = []
    for i in range(columns):
        x = -width / 2 + g + f + i * (w + f)
        for y0, y1 in ((g + f, 0.68 * height), (0.68 * height + f * 0.6, height - g - f)):
            panes.append((x, x + w, y0, y1, -t, t))
    frame = rectilinear([(-width / 2 + g, width / 2 - g, g, height - g, -t, t)], panes)
    sill = box(-width / 2 + g, width / 2 - g, g, 0.03, t + GAP, wall / 2 + 0.08)
    return (frame + sill).painted(material)


def stairs(width, steps, rise, run, riser, tread):
    """Solid, rising towards +z from z = 0, along x from 0 to `width`."""
    solid = rectilinear([(0, width, GAP, (i + 1) * rise, i * run, steps * run - 0.005)
                         for i in range(steps)]).painted(riser)
    return solid.painted_by(lambda normal, middle: tread if normal[1] > 0.5 else None)


def railing(feet, height, wood, metal):
    """Balusters on points, and a rail over them that follows their ends."""
    parts = [cylinder(0.009, GAP, height, 6, metal).moved(*p) for p in feet]
    rail = [(p[0], p[1] + height + 0.05, p[2]) for p in (feet[0], feet[-1])]
    return joined(parts) + tube(rail, 0.025, 10, wood)


def ceiling_lamp(radius, material, lit):
    """Hangs from y = 0 downwards; its underside shines."""
    ring = lathe([(radius * 0.93, -0.05), (radius, -0.05), (radius, -GAP), (0, -GAP)], 14, material)
    disc = lathe([(radius * 0.9, -0.06), (radius * 0.9, -0.05 - GAP)], 14, material)
    return (ring + disc).painted_by(
        lambda normal, middle: lit if normal[1] < -0.9 and middle[1] < -0.055 else None)


def pendant(drop, radius, shade, lit):
    """Hangs from y = 0 on a cord: a cone, with a shining disc in it."""
    cone = _ring(lathe([(radius, -drop), (radius + 0.006, -drop), (0.036, -drop + radius),
                        (0.03, -drop + radius)], 20, shade), 20, shade)
    disc = cylinder(radius * 0.62, -drop + 0.035, -drop + 0.045, 12, shade).painted_by(
        lambda normal, middle: lit if normal[1] < -0.9 else None)
    return cone + disc + cylinder(0.006, -drop + 0.045 + GAP, -GAP, 6, shade)


def floor_lamp(height, metal, shade, lit):
    foot = lathe([(0, 0), (0.14, 0), (0.14, 0.015), (0.03, 0.03), (0.012, 0.04), (0.012, height - 0.16),
                  (0, height - 0.16)], 12, metal)
    bulb = box(-0.05, 0.05, height - 0.15, height - 0.08, -0.05, 0.05, shade).painted_by(
        lambda normal, middle: lit if normal[1] > 0.9 else None)
    hood = lathe([(0.17, height - 0.24), (0.175, height - 0.24), (0.135, height), (0.13, height)], 14, shade)
    return foot + bulb + _ring(hood, 14, shade)


def _ring(shape, segments, material):
    """A lathed shell whose two caps are joined to each other instead of closed."""
    first, last = shape.faces[-2][0][::-1], shape.faces[-1][0]
    shape.faces = shape.faces[:-2]
    for k in range(segments):
        n = (k + 1) % segments
        shape.faces.append(([last[k], last[n], first[n], first[k]], material))
    return shape


def radiator(width, material):
    fins = round(width / 0.08)
    return joined(box(-0.03, 0.03, 0, 0.6, -0.035, 0.035, material)
                  .moved((i - (fins - 1) / 2) * 0.08, 0.12, 0) for i in range(fins))


def worktop(x0, x1, depth, holes, material):
    """At y = 0.88 to 0.92, its back at z = 0; holes as (x0, x1, z0, z1)."""
    return rectilinear([(x0, x1, 0.88, 0.92, 0, depth)],
                       [(a, b, 0.88, 0.92, c, d) for a, b, c, d in holes], 0.7).painted(material)


def sink(width, depth, metal):
    """A bowl whose rim lies over a hole of that size in a top at y = 0.92; origin in the middle."""
    w, d, t = width / 2 - 0.004, depth / 2 - 0.004, 0.003
    y0 = 0.74
    return rectilinear([(-w, w, y0, 0.924, -d, d), (-w - 0.02, w + 0.02, 0.922, 0.924, -d - 0.02, d + 0.02)],
                       [(-w + t, w - t, y0 + t, 0.924, -d + t, d - t)]).painted(metal)


def tap(height, reach, metal):
    arc = [(0, height - 0.08 + 0.08 * math.sin(a), reach / 2 * (1 - math.cos(a)))
           for a in (math.pi * k / 8 for k in range(9))]
    pipe = tube([(0, 0.03, 0), (0, height / 2, 0)] + arc + [(0, height - 0.13, reach)], 0.011, 10, metal)
    return pipe + cylinder(0.026, 0, 0.028, 14, metal) + tube(
        [(0.03, 0.05, 0), (0.07, 0.075, 0), (0.10, 0.08, 0)], 0.007, 8, metal)


def pot(radius, height, metal, black):
    body = lathe([(0, 0), (0.92 * radius, 0), (radius, 0.08 * height), (radius, height),
                  (0.97 * radius, height), (0.96 * radius, 0.08 * height), (0, 0.05 * height)], 18, metal)
    lid = lathe([(0, 0), (1.02 * radius, 0), (1.02 * radius, 0.006), (0.6 * radius, 0.022), (0.12 * radius, 0.03),
                 (0, 0.03)], 18, metal).moved(y=height + GAP)
    knob = ball(0.016, 6, 10, black).moved(y=height + 0.030 + 0.018 + GAP)
    ears = joined(bar_handle((-0.04, height * 0.75, radius + 0.008), (0.04, height * 0.75, radius + 0.008),
                             black).turned(t) for t in (90, -90))
    return joined([body, lid, knob, ears])


def pan(radius, black):
    body = lathe([(0, 0), (0.85 * radius, 0), (radius, 0.045), (0.97 * radius, 0.045), (0.82 * radius, 0.006),
                  (0, 0.006)], 28, black)
    return body + tube([(radius + 0.004, 0.035, 0), (radius + 0.08, 0.05, 0), (radius + 0.2, 0.055, 0)],
                       [0.008, 0.009, 0.011], 8, black)


def bottle(height, material):
    return lathe([(r * height, y * height) for r, y in
                  ((0, 0), (0.13, 0), (0.14, 0.02), (0.14, 0.55), (0.11, 0.66), (0.05, 0.75), (0.045, 0.97),
                   (0.055, 0.97), (0.055, 1), (0, 1))], 12, material)


def oven(width, front, glass, metal):
    body = box(-width / 2, width / 2, 0.06, 0.876, 0.01, 0.56, front)
    door = cushion(width - 0.01, 0.5, 0.025, 0.004, 1, front).moved(0, 0.14, 0.5745)
    pane = cushion(width - 0.12, 0.32, 0.004, 0.0015, 1, glass).moved(0, 0.20, 0.590)
    panel = cushion(width - 0.01, 0.12, 0.025, 0.004, 1, metal).moved(0, 0.70, 0.5745)
    knobs = joined(cylinder(0.02, 0, 0.022, 14, glass).turned(90, "x")
                   .moved((i - 2) * 0.1, 0.76, 0.590) for i in range(5))
    return joined([body, door, pane, panel, knobs,
                   bar_handle((-0.2, 0.595, 0.595), (0.2, 0.595, 0.595), metal)])


def hob(width, glass, ring):
    plate = cushion(width, 0.008, 0.5, 0.003, 1, glass)
    rings = joined(_ring(lathe([(r - 0.006, 0), (r, 0), (r, 0.001), (r - 0.006, 0.001)], 16, ring), 16, ring)
                   .moved(x, 0.009, z) for x, z, r in
                   ((-0.15, 0.11, 0.09), (0.15, 0.11, 0.07), (-0.15, -0.12, 0.07), (0.15, -0.12, 0.09)))
    return plate + rings


def hood(width, metal, lit):
    """Its back at z = 0, its rim at y = 0; a chimney of 0.7 m."""
    w, d = width / 2, 0.48
    rim = box(-w, w, 0, 0.05, 0.005, d, metal)
    funnel = Shape([(-w, 0.052, 0.005), (w, 0.052, 0.005), (w, 0.052, d), (-w, 0.052, d),
                    (-0.13, 0.28, 0.005), (0.13, 0.28, 0.005), (0.13, 0.28, 0.26), (-0.13, 0.28, 0.26)],
                   [(f, metal) for f in ([0, 1, 2, 3], [7, 6, 5, 4], [3, 2, 6, 7], [1, 0, 4, 5],
                                         [2, 1, 5, 6], [0, 3, 7, 4])])
    lamp = box(-0.16, 0.16, -0.012, -GAP, 0.2, 0.26, metal).painted_by(
        lambda normal, middle: lit if normal[1] < -0.9 else None)
    return joined([rim, funnel, box(-0.125, 0.125, 0.282, 0.98, 0.006, 0.25, metal), lamp])


def fridge(front, metal):
    body = box(-0.3, 0.3, 0.03, 1.95, -0.3, 0.27, front)
    doors = joined(cushion(0.596, h, 0.04, 0.01, 1, front).moved(0, y, 0.293)
                   for y, h in ((0.035, 0.70), (0.742, 1.205)))
    handles = bar_handle((-0.25, 0.45, 0.318), (-0.25, 0.70, 0.318), metal) + bar_handle(
        (-0.25, 0.78, 0.318), (-0.25, 1.15, 0.318), metal)
    feet = joined(cylinder(0.02, 0, 0.028, 8, metal).moved(x, 0, z) for x in (-0.25, 0.25) for z in (-0.25, 0.2))
    return joined([body, doors, handles, feet])


def oval(profile, stretch, segments, material):
    return lathe(profile, segments, material).scaled(stretch, 1, 1)


def bath_tub(white, metal):
    """1.7 by 0.8; its tap at the -x end."""
    profile = [(0, 0.02), (0.27, 0.02), (0.33, 0.10), (0.375, 0.52), (0.40, 0.56), (0.40, 0.59), (0.34, 0.59),
               (0.325, 0.54), (0.28, 0.18), (0.22, 0.13), (0, 0.12)]
    tub = oval(profile, 2.1, 28, white)
    feet = joined(ball(0.045, 6, 10, metal).scaled(1, 0.2, 1).moved(x, 0.009, z)
                  for x in (-0.4, 0.4) for z in (-0.15, 0.15))
    return tub + feet


def toilet(white):
    bowl = lathe([(0, 0), (0.13, 0), (0.12, 0.12), (0.17, 0.30), (0.19, 0.40), (0.155, 0.40), (0.12, 0.28),
                  (0.05, 0.2), (0, 0.19)], 16, white).scaled(1, 1, 1.3).moved(z=0.03)
    lid = cylinder(0.19, 0.402, 0.425, 16, white).scaled(1, 1, 1.3).moved(z=0.03)
    tank = cushion(0.40, 0.36, 0.16, 0.03, 1, white).moved(0, 0.43, -0.31)
    return joined([bowl, lid, tank])


def basin(white, metal, wood, glass):
    """On a cupboard, with a tap, and a mirror on the wall behind at z = -0.25."""
    stand = box(-0.35, 0.35, 0.25, 0.80, -0.245, 0.20, wood)
    drawer = cushion(0.68, 0.50, 0.018, 0.004, 1, wood).moved(0, 0.275, 0.212)
    bowl = lathe([(0, 0), (0.13, 0), (0.2, 0.10), (0.21, 0.14), (0.195, 0.14), (0.18, 0.10), (0.1, 0.03),
                  (0, 0.025)], 18, white).scaled(1.25, 1, 0.9).moved(0, 0.802, 0)
    fitting = tap(0.28, 0.13, metal).moved(0, 0.802, -0.215)
    mirror = cushion(0.7, 0.8, 0.02, 0.004, 1, glass).moved(0, 1.15, -0.235)
    return joined([stand, drawer, bowl, fitting, mirror])


def towel_rail(white, metal):
    bars = joined(tube([(-0.25, 0.5 + 0.12 * i, 0.05), (0.25, 0.5 + 0.12 * i, 0.05)], 0.009, 8, metal)
                  for i in range(7))
    posts = joined(cylinder(0.013, 0.4, 1.55, 8, metal).moved(s * 0.27, 0, 0.05) for s in (-1, 1))
    towel = cushion(0.4, 0.55, 0.016, 0.006, 1, white, 2).moved(0, 0.7, 0.08)
    return joined([bars, posts, towel])
