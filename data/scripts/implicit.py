"""Closed organic meshes: smooth unions of simple bodies, and the triangles of their surface.

A body is a function of a point, negative inside, about the distance to its surface.
"""
import math

from mesh import Shape, add, cross, dot, normalized, scale, subtract


def ellipsoid(centre, radii, degrees=0.0):
    """Turned about z, counter-clockwise seen from +z."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    rx, ry, rz = radii

    def distance(p):
        x, y, z = p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]
        x, y = (c * x + s * y) / rx, (c * y - s * x) / ry
        z /= rz
        k0 = math.sqrt(x * x + y * y + z * z)
        k1 = math.sqrt((x / rx) ** 2 + (y / ry) ** 2 + (z / rz) ** 2)
        return -min(radii) if k1 == 0 else k0 * (k0 - 1) / k1
    return distance


def limb(a, b, radius_a, radius_b):
    """A rod with round ends, thicker at one."""
    axis = subtract(b, a)
    length2 = dot(axis, axis)

    def distance(p):
        q = subtract(p, a)
        t = min(1.0, max(0.0, dot(q, axis) / length2))
        x, y, z = q[0] - t * axis[0], q[1] - t * axis[1], q[2] - t * axis[2]
        return math.sqrt(x * x + y * y + z * z) - (radius_a + t * (radius_b - radius_a))
    return distance


def blended(bodies):
    """Union of (body, width): each body melts into those before it over about that width."""
    def distance(p):
        d = math.inf
        for body, width in bodies:
            e = body(p)
            if abs(d - e) >= width:
                d = min(d, e)
            else:
                h = width - abs(d - e)
                d = min(d, e) - h * h / (4 * width)
        return d
    return distance


def surface_of(body, low, high, cell, material, smoothing=3):
    """Triangles of the surface within a box, by dual cells: one vertex in each cell that the surface
    crosses, joined around each grid edge that it crosses, then spread evenly over the surface.
    The surface must stay clear of the box's sides and be thicker than two cells everywhere.
    """
    counts = [math.ceil((h - l) / cell) for l, h in zip(low, high)]

    def place(i, j, k):
        return (low[0] + i * cell, low[1] + j * cell, low[2] + k * cell)
    value = {(i, j, k): body(place(i, j, k)) for i in range(counts[0] + 1)
             for j in range(counts[1] + 1) for k in range(counts[2] + 1)}

    crossings = []  # (edge's first point, axis, point on the surface)
    for point, d in value.items():
        for axis in range(3):
            ahead = list(point)
            ahead[axis] += 1
            e = value.get(tuple(ahead), d)
            if (d < 0) != (e < 0):
                on = list(map(float, place(*point)))
                on[axis] += cell * d / (d - e)
                crossings.append((point, axis, tuple(on)))

    numbers, sums, quads = {}, [], []
    for point, axis, on in crossings:
        around = []
        for du, dv in ((-1, -1), (0, -1), (0, 0), (-1, 0)):
            c = list(point)
            c[(axis + 1) % 3] += du
            c[(axis + 2) % 3] += dv
            number = numbers.setdefault(tuple(c), len(sums))
            if number == len(sums):
                sums.append([0.0, 0.0, 0.0, 0])
            sums[number] = [a + b for a, b in zip(sums[number], (*on, 1))]
            around.append(number)
        quads.append(around if value[point] < 0 else around[::-1])
    vertices = [(x / n, y / n, z / n) for x, y, z, n in sums]
    return _triangles(_smoothed(vertices, quads, body, cell, smoothing), quads, material)


def _smoothed(vertices, quads, body, cell, rounds):
    neighbours = [set() for _ in vertices]
    for q in quads:
        for a, b in zip(q, q[1:] + q[:1]):
            neighbours[a].add(b)
            neighbours[b].add(a)

    def on_surface(p):
        for _ in range(2):
            step = 0.05 * cell
            d = body(p)
            gradient = tuple((body(add(p, e)) - d) / step
                             for e in ((step, 0, 0), (0, step, 0), (0, 0, step)))
            p = subtract(p, scale(gradient, d / max(dot(gradient, gradient), 0.25)))
        return p
    for _ in range(rounds):
        middles = []
        for v, around in zip(vertices, neighbours):
            mean = (0.0, 0.0, 0.0)
            for n in sorted(around):
                mean = add(mean, scale(vertices[n], 1 / len(around)))
            middles.append(on_surface(add(scale(v, 0.5), scale(mean, 0.5))))
        vertices = middles
    return vertices


def _triangles(vertices, quads, material):
    """Cuts each quadrilateral so that its halves face alike best."""
    def normal(a, b, c):
        return normalized(cross(subtract(vertices[b], vertices[a]),
                                subtract(vertices[c], vertices[a])))
    shape = Shape(vertices)
    for a, b, c, d in quads:
        if dot(normal(a, b, c), normal(a, c, d)) >= dot(normal(b, c, d), normal(b, d, a)):
            halves = ([a, b, c], [a, c, d])
        else:
            halves = ([b, c, d], [b, d, a])
        shape.faces += [(half, material) for half in halves]
    return shape
