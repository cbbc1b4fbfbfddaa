"""Polygon meshes for the scene scripts: closed solids, and OBJ + MTL to hold them.

Solids are closed and wound outwards; Scene.add checks that, so a script that ends without an error
has written sound geometry. Angles are in degrees, y is up. Everything is deterministic.
"""
import argparse
import math
import sys
from collections import Counter
from pathlib import Path

COORDINATE = "%.5f"


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    return scale(a, 1 / math.sqrt(dot(a, a)))


def cos_sin(degrees):
    """Exact for quarter turns."""
    quarter, rest = divmod(degrees, 90)
    if rest == 0:
        return ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarter) % 4]
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


class Shape:
    """Vertices, and faces as (corners, material); corners turn counter-clockwise seen from outside."""

    def __init__(self, vertices=(), faces=()):
        self.vertices = list(vertices)
        self.faces = list(faces)

    def __add__(self, other):
        first = len(self.vertices)
        return Shape(self.vertices + other.vertices,
                     self.faces + [([first + c for c in corners], m) for corners, m in other.faces])

    def mapped(self, function):
        return Shape([function(v) for v in self.vertices], self.faces)

    def moved(self, x=0.0, y=0.0, z=0.0):
        return self.mapped(lambda v: (v[0] + x, v[1] + y, v[2] + z))

    def turned(self, degrees, axis="y"):
        """Counter-clockwise seen from the axis' tip."""
        c, s = cos_sin(degrees)
        i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]

        def turn(v):
            w = list(v)
            w[i], w[j] = c * v[i] - s * v[j], s * v[i] + c * v[j]
            return tuple(w)
        return self.mapped(turn)

    def scaled(self, x, y, z):
        """All factors positive."""
        return self.mapped(lambda v: (v[0] * x, v[1] * y, v[2] * z))

    def painted(self, material):
        return Shape(self.vertices, [(corners, material) for corners, _ in self.faces])

    def painted_by(self, material_of):
        """`material_of` is asked with a face's unit normal and its corners' mean, and may say None
        for "as it is"."""
        return Shape(self.vertices,
                     [(corners, material_of(self.normal(corners), self.middle(corners)) or m)
                      for corners, m in self.faces])

    def middle(self, corners):
        return tuple(sum(self.vertices[c][i] for c in corners) / len(corners) for i in range(3))

    def area_vector(self, corners):
        p = [self.vertices[c] for c in corners]
        total = (0.0, 0.0, 0.0)
        for a, b in zip(p[1:], p[2:]):
            total = add(total, cross(subtract(a, p[0]), subtract(b, p[0])))
        return scale(total, 0.5)

    def normal(self, corners):
        return normalized(self.area_vector(corners))

    def volume(self):
        return sum(dot(self.vertices[corners[0]], self.area_vector(corners))
                   for corners, _ in self.faces) / 3

    def unmatched_edges(self):
        """Directed edges without their opposite: none in a closed, consistently wound mesh."""
        edges = Counter((a, b) for corners, _ in self.faces
                        for a, b in zip(corners, corners[1:] + corners[:1]))
        return [e for e, n in edges.items() if edges[e[::-1]] != n]

    def triangle_count(self):
        return sum(len(corners) - 2 for corners, _ in self.faces)


def box(x0, x1, y0, y1, z0, z1, material=None):
    return rectilinear([(x0, x1, y0, y1, z0, z1)]).painted(material)


def rectilinear(solids, holes=(), longest=math.inf):
    """The union of boxes (x0, x1, y0, y1, z0, z1) less others. Its faces are merged to rectangles
    no longer than asked, and carry the corners of their neighbours, so that no edge has a T-junction.
    """
    breaks = [sorted({b[2 * axis + side] for b in [*solids, *holes] for side in (0, 1)})
              for axis in range(3)]
    number = [{value: i for i, value in enumerate(values)} for values in breaks]

    def cells_of(b):
        ranges = [range(number[a][b[2 * a]], number[a][b[2 * a + 1]]) for a in range(3)]
        return ((i, j, k) for i in ranges[0] for j in ranges[1] for k in ranges[2])
    filled = {cell for b in solids for cell in cells_of(b)}
    for b in holes:
        filled.difference_update(cells_of(b))

    rectangles = []
    for axis in range(3):
        for side in (0, 1):
            rectangles += _merged_faces(filled, breaks, axis, side, longest)
    return _with_shared_corners(rectangles, breaks)


def _merged_faces(filled, breaks, axis, side, longest):
    """Rectangles (axis, side, plane, u0, u1, v0, v1) in numbers of breaks."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    step = 1 if side else -1
    open_faces = set()
    for cell in filled:
        next_cell = list(cell)
        next_cell[axis] += step
        if tuple(next_cell) not in filled:
            open_faces.add((cell[axis] + side, cell[u], cell[v]))
    for plane, u0, v0 in sorted(open_faces):
        if (plane, u0, v0) not in open_faces:
            continue
        u1, v1 = u0 + 1, v0 + 1
        while (plane, u1, v0) in open_faces and breaks[u][u1 + 1] - breaks[u][u0] <= longest:
            u1 += 1
        while (all((plane, i, v1) in open_faces for i in range(u0, u1))
               and breaks[v][v1 + 1] - breaks[v][v0] <= longest):
            v1 += 1
        open_faces.difference_update((plane, i, j) for i in range(u0, u1) for j in range(v0, v1))
        yield axis, side, plane, u0, u1, v0, v1


def _with_shared_corners(rectangles, breaks):
    def corner(axis, plane, i, j):
        c = [0, 0, 0]
        c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3] = plane, i, j
        return tuple(c)
    used = {corner(axis, plane, i, j) for axis, _, plane, u0, u1, v0, v1 in rectangles
            for i in (u0, u1) for j in (v0, v1)}
    numbers, shape = {}, Shape()
    for axis, side, plane, u0, u1, v0, v1 in rectangles:
        around = ([(i, v0) for i in range(u0, u1)] + [(u1, j) for j in range(v0, v1)]
                  + [(i, v1) for i in range(u1, u0, -1)] + [(u0, j) for j in range(v1, v0, -1)])
        outline = [c for c in (corner(axis, plane, i, j) for i, j in around) if c in used]
        if not side:
            outline.reverse()
        for c in outline:
            if c not in numbers:
                numbers[c] = len(shape.vertices)
                shape.vertices.append(tuple(breaks[a][c[a]] for a in range(3)))
        shape.faces.append(([numbers[c] for c in outline], None))
    return shape


def lathe(profile, segments, material=None):
    """Turns points (radius, y) about the y axis. From axis to axis, bottom to top along the outside
    (and down again along the inside of a vessel); a profile that does not touch the axis is capped.
    """
    shape, rings = Shape(), []
    for radius, y in profile:
        count = 1 if radius == 0 else segments
        rings.append(range(len(shape.vertices), len(shape.vertices) + count))
        for k in range(count):
            c, s = cos_sin(360 * k / segments)
            shape.vertices.append((radius * s, y, radius * c))
    for below, above in zip(rings, rings[1:]):
        for k in range(segments):
            corners = [below[k % len(below)], below[(k + 1) % len(below)],
                       above[(k + 1) % len(above)], above[k % len(above)]]
            corners = [c for i, c in enumerate(corners) if c != corners[i - 1]]
            shape.faces.append((corners, material))
    if len(rings[0]) > 1:
        shape.faces.append((list(reversed(rings[0])), material))
    if len(rings[-1]) > 1:
        shape.faces.append((list(rings[-1]), material))
    return shape


def cylinder(radius, y0, y1, segments, material=None):
    return lathe([(radius, y0), (radius, y1)], segments, material)


def ball(radius, rings, segments, material=None):
    arc = [cos_sin(180 * i / rings - 90) for i in range(1, rings)]
    return lathe([(0, -radius)] + [(radius * c, radius * s) for c, s in arc] + [(0, radius)],
                 segments, material)


def tube(path, radius, segments, material=None):
    """A round bar along points; `radius` may be a list, one a point."""
    radii = radius if isinstance(radius, list) else [radius] * len(path)
    shape, rings = Shape(), []
    side = None
    for i, point in enumerate(path):
        ahead = normalized(subtract(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)]))
        if side is None:
            side = cross(ahead, (0, 1, 0) if abs(ahead[1]) < 0.9 else (1, 0, 0))
        side = normalized(subtract(side, scale(ahead, dot(side, ahead))))
        other = cross(ahead, side)
        rings.append(list(range(len(shape.vertices), len(shape.vertices) + segments)))
        for k in range(segments):
            c, s = cos_sin(360 * k / segments)
            shape.vertices.append(add(point, add(scale(side, radii[i] * c),
                                                 scale(other, radii[i] * s))))
    for below, above in zip(rings, rings[1:]):
        for k in range(segments):
            n = (k + 1) % segments
            shape.faces.append(([below[k], below[n], above[n], above[k]], material))
    shape.faces.append((rings[0][::-1], material))
    shape.faces.append((rings[-1], material))
    return shape


def prism(outline, y0, y1, material=None):
    """An outline of (x, z), counter-clockwise seen from above (from +x towards -z), raised."""
    n = len(outline)
    shape = Shape([(x, y, z) for y in (y0, y1) for x, z in outline])
    shape.faces = [([k, (k + 1) % n, n + (k + 1) % n, n + k], material) for k in range(n)]
    shape.faces += [(list(range(n))[::-1], material), (list(range(n, 2 * n)), material)]
    return shape


def cushion(x, y, z, radius, steps, material=None, flat=1, bulge=0.0):
    """A box of that size with round edges, standing on the origin. Its sides are of `flat` squared
    pieces; along its thinnest axis it may bulge."""
    half = (x / 2, y / 2, z / 2)
    thin = half.index(min(half))
    arcs = [math.tan(math.radians(45 * i / steps)) for i in range(1, steps + 1)]
    # (place along the core's side, slope of the arc beyond it)
    grid = ([(-1, -a) for a in reversed(arcs)] + [(2 * i / flat - 1, 0) for i in range(flat + 1)]
            + [(1, a) for a in arcs])
    numbers, shape = {}, Shape()

    def vertex(axis, sign, a, b):
        core, out = [0, 0, 0], [0, 0, 0]
        for i, (side, slope) in ((axis, (sign, sign)), ((axis + 1) % 3, a), ((axis + 2) % 3, b)):
            core[i], out[i] = side * (half[i] - radius), slope
        p = list(add(core, scale(normalized(out), radius)))
        j, k = (thin + 1) % 3, (thin + 2) % 3
        p[thin] *= 1 + bulge * (1 - (p[j] / half[j]) ** 2) * (1 - (p[k] / half[k]) ** 2)
        key = tuple(round(c, 7) for c in p)
        if key not in numbers:
            numbers[key] = len(shape.vertices)
            shape.vertices.append((p[0], p[1] + half[1], p[2]))
        return numbers[key]
    for axis in range(3):
        for sign in (-1, 1):
            for a0, a1 in zip(grid, grid[1:]):
                for b0, b1 in zip(grid, grid[1:]):
                    corners = [vertex(axis, sign, *ab)
                               for ab in ((a0, b0), (a1, b0), (a1, b1), (a0, b1))]
                    shape.faces.append((corners if sign > 0 else corners[::-1], material))
    return shape


class Material:
    """Diffuse albedo, max-Phong albedo at normal incidence and exponent, emitted radiance."""

    def __init__(self, kd, ks=(0, 0, 0), ns=0, ke=(0, 0, 0)):
        self.kd, self.ks, self.ns, self.ke = kd, ks, ns, ke

    def lines(self):
        def colour(keyword, c):
            return keyword + " " + " ".join("%g" % v for v in c)
        lines = [colour("Kd", self.kd)]
        if max(self.ks) > 0:
            lines += [colour("Ks", self.ks), "Ns %g" % self.ns, "illum 2"]
        if max(self.ke) > 0:
            lines.append(colour("Ke", self.ke))
        return lines


def grey(value):
    return (value, value, value)


class Scene:
    """Named shapes, materials and cameras."""

    def __init__(self, title, materials):
        self.title, self.materials = title, materials
        self.objects, self.cameras = [], []

    def add(self, name, shape):
        """A solid: \\raise ValueError unless it is closed and wound outwards."""
        if shape.unmatched_edges():
            raise ValueError("%s: %d open edges" % (name, len(shape.unmatched_edges())))
        if shape.volume() <= 0:
            raise ValueError(name + ": wound inwards")
        self.add_open(name, shape)

    def add_open(self, name, shape):
        for _, material in shape.faces:
            if material not in self.materials:
                raise ValueError("%s: no material %s" % (name, material))
        self.objects.append((name, shape))

    def add_camera(self, name, eye, look_at, fov, up=(0, 1, 0)):
        self.cameras.append((name, eye, look_at, up, fov))

    def emits(self, material):
        return max(self.materials[material].ke) > 0

    def counts(self):
        shapes = [shape for _, shape in self.objects]
        return {
            "objects": len(shapes),
            "polygons": sum(len(s.faces) for s in shapes),
            "triangles": sum(s.triangle_count() for s in shapes),
            "vertices": sum(len(s.vertices) for s in shapes),
            "emitting polygons": sum(self.emits(m) for s in shapes for _, m in s.faces),
        }

    def write(self, obj):
        """NAME.obj and NAME.mtl."""
        obj = Path(obj)
        obj.parent.mkdir(parents=True, exist_ok=True)
        with open(obj.with_suffix(".mtl"), "w", encoding="ascii", newline="\n") as mtl:
            for name, material in self.materials.items():
                mtl.write("\n".join(["newmtl " + name, *material.lines()]) + "\n\n")
        with open(obj, "w", encoding="ascii", newline="\n") as out:
            out.write("# %s\n# camera NAME eye look-at up vertical-field-of-view\n" % self.title)
            for name, *vectors, fov in self.cameras:
                numbers = " ".join("%g" % c for v in vectors for c in v)
                out.write("# camera %s %s %g\n" % (name, numbers, fov))
            out.write("mtllib %s\n" % obj.with_suffix(".mtl").name)
            first = 1
            for name, shape in self.objects:
                first = _write_object(out, name, shape, first)

    def report(self, obj):
        print("%s: %s" % (obj, ", ".join("%d %s" % (n, what) for what, n in self.counts().items())))


def _write_object(out, name, shape, first):
    out.write("o %s\n" % name)
    for v in shape.vertices:
        # Adding 0 makes a negative zero positive.
        out.write("v " + " ".join(COORDINATE % (round(c, 5) + 0.0) for c in v) + "\n")
    current = None
    for corners, material in shape.faces:
        if material != current:
            out.write("usemtl %s\n" % material)
            current = material
        out.write("f " + " ".join(str(first + c) for c in corners) + "\n")
    return first + len(shape.vertices)


def parse_arguments(description, *options):
    """`options` as (name, keywords) of add_argument, beside the folder to write into."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default="build/scenes",
                        help="where to write (default: %(default)s)")
    for name, keywords in options:
        parser.add_argument(name, **keywords)
    return parser.parse_args()


def write_scene(scene, path):
    """Writes and prints the counts; a script's last step."""
    try:
        scene.write(path)
    except OSError as error:
        sys.exit("%s: %s" % (path, error.strerror))
    scene.report(path)
