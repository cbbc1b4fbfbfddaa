#!/usr/bin/env python3
"""Writes the Cornell box, by its measured geometry in millimetres, as glTF with an embedded buffer.

Usage: make_cornell.py [OUTPUT]   (default: ../scenes/cornell.gltf beside this script)

Data: Cornell University Program of Computer Graphics, "The Cornell Box", as published with its
measured coordinates. Two liberties, so that every polygon is planar and no two overlap:
  * The red wall's quad (x = 552.8 and 549.6 at the floor, 556 at the ceiling) is 3 mm off a plane.
    It is cut into two triangles along the diagonal from the floor's front to the ceiling's back.
  * The light hangs 0.5 mm below the ceiling, with which it is coplanar in the original.
The blocks have no bottom. The box is open towards the camera "front".
"""
import base64
import json
import math
import struct
import sys
from pathlib import Path

CEILING = 548.8
LIGHT_GAP = 0.5

# glTF's numbers
FLOAT, UNSIGNED_SHORT = 5126, 5123
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963

# name: (linear base colour, emission, double-sided)
MATERIALS = {
    "white": ((0.725, 0.71, 0.68), None, True),
    "red": ((0.63, 0.065, 0.05), None, True),
    "green": ((0.14, 0.45, 0.091), None, True),
    "light": ((0.78, 0.78, 0.78), (17.0, 12.0, 4.0), False),
}

# Corners turn counter-clockwise seen from inside the box.
ROOM = {
    "floor": ("white", [[(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)]]),
    "ceiling": ("white", [[(556, CEILING, 0), (556, CEILING, 559.2),
                           (0, CEILING, 559.2), (0, CEILING, 0)]]),
    "back wall": ("white", [[(549.6, 0, 559.2), (0, 0, 559.2),
                             (0, CEILING, 559.2), (556, CEILING, 559.2)]]),
    "green wall": ("green", [[(0, 0, 559.2), (0, 0, 0), (0, CEILING, 0), (0, CEILING, 559.2)]]),
    "red wall": ("red", [[(552.8, 0, 0), (549.6, 0, 559.2), (556, CEILING, 559.2)],
                         [(552.8, 0, 0), (556, CEILING, 559.2), (556, CEILING, 0)]]),
    "light": ("light", [[(343, CEILING - LIGHT_GAP, 227), (343, CEILING - LIGHT_GAP, 332),
                         (213, CEILING - LIGHT_GAP, 332), (213, CEILING - LIGHT_GAP, 227)]]),
}

BLOCKS = {
    "short block": (165, [(130, 65), (82, 225), (240, 272), (290, 114)]),
    "tall block": (330, [(423, 247), (265, 296), (314, 456), (472, 406)]),
}

# name: (eye, look at, vertical field of view in degrees)
FRONT_FOV = 2 * math.degrees(math.atan(25 / 2 / 35))  # film 25 mm, focal length 35 mm
CAMERAS = {
    "front": ((278, 273, -800), (278, 273, 0), FRONT_FOV),
    "corner": ((40, 500, 30), (320, 140, 330), 65.0),
}


def block_faces(height, outline):
    """Top and sides; the outline turns counter-clockwise seen from above."""
    top = [(x, height, z) for x, z in outline]
    sides = []
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        sides.append([(x0, height, z0), (x0, 0, z0), (x1, 0, z1), (x1, height, z1)])
    return [top] + sides


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def camera_matrix(eye, look_at):
    """Column-major; a glTF camera looks along its -z axis."""
    z = normalized(subtract(eye, look_at))
    x = normalized(cross((0, 1, 0), z))
    y = cross(z, x)
    return [*x, 0.0, *y, 0.0, *z, 0.0, *map(float, eye), 1.0]


class Builder:
    def __init__(self):
        self.buffer = bytearray()
        self.document = {
            "asset": {"version": "2.0", "generator": "make_cornell.py"},
            "extensionsUsed": ["KHR_materials_emissive_strength", "KHR_materials_specular"],
            "scene": 0,
            "scenes": [{"name": "Cornell box, millimetres", "nodes": []}],
            "nodes": [], "cameras": [], "materials": [], "meshes": [],
            "accessors": [], "bufferViews": [],
        }

    def add(self, array, element):
        self.document[array].append(element)
        return len(self.document[array]) - 1

    def add_node(self, node):
        self.document["scenes"][0]["nodes"].append(self.add("nodes", node))

    def add_material(self, name, colour, emission, double_sided):
        material = {
            "name": name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [*colour, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0},
            "doubleSided": double_sided,
            "extensions": {"KHR_materials_specular": {"specularFactor": 0.0}},  # Lambert
        }
        if emission:
            strength = max(emission)
            material["emissiveFactor"] = [round(c / strength, 9) for c in emission]
            material["extensions"]["KHR_materials_emissive_strength"] = {
                "emissiveStrength": strength}
        self.add("materials", material)

    def add_accessor(self, data, target, **accessor):
        view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data),
                "target": target}
        self.buffer += data + bytes(-len(data) % 4)
        return self.add("accessors", {"bufferView": self.add("bufferViews", view), **accessor})

    def add_object(self, name, material, faces):
        corners = [corner for face in faces for corner in face]
        indices, first = [], 0
        for face in faces:
            for i in range(1, len(face) - 1):
                indices += [first, first + i, first + i + 1]
            first += len(face)
        stored = [struct.unpack("<3f", struct.pack("<3f", *c)) for c in corners]
        positions = self.add_accessor(
            b"".join(struct.pack("<3f", *c) for c in corners), ARRAY_BUFFER,
            componentType=FLOAT, count=len(corners), type="VEC3",
            min=[min(axis) for axis in zip(*stored)], max=[max(axis) for axis in zip(*stored)])
        index = self.add_accessor(
            struct.pack(f"<{len(indices)}H", *indices), ELEMENT_ARRAY_BUFFER,
            componentType=UNSIGNED_SHORT, count=len(indices), type="SCALAR")
        primitive = {"attributes": {"POSITION": positions}, "indices": index,
                     "material": list(MATERIALS).index(material)}
        mesh = self.add("meshes", {"name": name, "primitives": [primitive]})
        self.add_node({"name": name, "mesh": mesh})

    def add_camera(self, name, eye, look_at, fov):
        perspective = {"yfov": math.radians(fov), "aspectRatio": 1.0, "znear": 1.0}
        camera = self.add(
            "cameras", {"name": name, "type": "perspective", "perspective": perspective})
        self.add_node({"name": name, "camera": camera, "matrix": camera_matrix(eye, look_at)})

    def finished(self):
        data = base64.b64encode(self.buffer).decode("ascii")
        uri = "data:application/octet-stream;base64," + data
        return {**self.document, "buffers": [{"byteLength": len(self.buffer), "uri": uri}]}


def make_cornell():
    builder = Builder()
    for name, (colour, emission, double_sided) in MATERIALS.items():
        builder.add_material(name, colour, emission, double_sided)
    for name, (material, faces) in ROOM.items():
        builder.add_object(name, material, faces)
    for name, (height, outline) in BLOCKS.items():
        builder.add_object(name, "white", block_faces(height, outline))
    for name, (eye, look_at, fov) in CAMERAS.items():
        builder.add_camera(name, eye, look_at, fov)
    return builder.finished()


def main():
    default = Path(__file__).resolve().parent.parent / "scenes" / "cornell.gltf"
    output = Path(sys.argv[1]) if len(sys.argv) > 1 else default
    output.write_text(json.dumps(make_cornell(), indent=1) + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
