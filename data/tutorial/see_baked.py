"""Imports a mesh that `transillum export` wrote into Blender, tells what it holds and renders it.

Usage: blender --background --python see_baked.py -- BAKED.glb PICTURE.png [ROOM.glb]

The camera is the one of ROOM.glb. The vertex colours are shown as they are, without any light.
"""
import sys

import bpy
import numpy

if "bool" not in numpy.__dict__:
    numpy.bool = bool  # Blender 3.4 imports glTF by a name that NumPy dropped in 1.24


def imported(file):
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=file)
    return [o for o in bpy.data.objects if o not in before]


baked, picture, *room = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
meshes = [o for o in imported(baked) if o.type == "MESH"]
for o in meshes:
    mesh = o.data
    print(f"{o.name}: {len(mesh.vertices)} vertices, {len(mesh.polygons)} triangles; colour attributes:",
          ", ".join(f"{a.name} ({a.domain}, {a.data_type})" for a in mesh.color_attributes))
if room:
    for o in imported(room[0]):
        if o.type == "CAMERA":
            scene.camera = o
        else:
            bpy.data.objects.remove(o)
    scene.render.engine = "BLENDER_EEVEE"  # Cycles doesn't leave out the backs of triangles
    scene.render.dither_intensity, scene.render.image_settings.color_mode = 0, "RGB"
    scene.render.resolution_x, scene.render.resolution_y = 360, 270
    scene.view_settings.view_transform = "Standard"  # not Filmic: the colours are tone-mapped already
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
