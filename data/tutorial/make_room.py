"""Models a furnished room in Blender and exports it as glTF, in metres.

Usage: blender --background --python make_room.py [-- ROOM.glb]   (default: room.glb)

Everything that reflects is a Principled BSDF, everything that shines its emission: glTF holds these.
"""
import math
import sys

import bpy
from mathutils import Vector

WIDTH, DEPTH, HEIGHT, WALL = 5.0, 4.0, 2.7, 0.1  # of the room's inside, about x = y = 0, and its walls
TABLE = Vector((-0.2, 0.3, 0.0))


def material(name, colour, roughness=1.0, metallic=0.0, specular=0.5, strength=0.0):
    """`colour` of what shines is that of its light, and `strength` its radiance [W sr^-1 m^-2]."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.use_backface_culling = False  # exported as doubleSided
    inputs = made.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*((0.0,) * 3 if strength else colour), 1.0)
    inputs["Roughness"].default_value = roughness
    inputs["Metallic"].default_value = metallic
    inputs["Specular"].default_value = specular  # 0.5: refractive index 1.5, 0: a Lambert surface
    if strength:
        inputs["Emission"].default_value = (*colour, 1.0)
        inputs["Emission Strength"].default_value = strength
    return made


def named(name, of, smooth=False):
    """The object that an operator has just made."""
    made = bpy.context.object
    made.name = made.data.name = name
    made.data.materials.clear()
    made.data.materials.append(of)
    if smooth:
        bpy.ops.object.shade_smooth()
    return made


def box(name, of, low, high, bevel=0.0):
    low, high = Vector(low), Vector(high)
    bpy.ops.mesh.primitive_cube_add(size=1, location=(low + high) / 2)
    made = named(name, of)
    made.scale = high - low
    bpy.ops.object.transform_apply(location=False, rotation=False)
    if bevel:
        made.modifiers.new("Bevel", "BEVEL").width = bevel
    return made


def joined(name, parts):
    bpy.ops.object.select_all(action="DESELECT")
    for part in parts:
        part.select_set(True)
    bpy.context.view_layer.objects.active = parts[0]
    bpy.ops.object.join()
    parts[0].name = parts[0].data.name = name
    return parts[0]


def standing(width, depth, height, radius, of):
    """Four legs about the origin."""
    return [box("leg", of, (x - radius, y - radius, 0), (x + radius, y + radius, height))
            for x in (radius - width / 2, width / 2 - radius) for y in (radius - depth / 2, depth / 2 - radius)]


def add_shell():
    x, y = WIDTH / 2, DEPTH / 2
    plaster = material("plaster", (0.75, 0.73, 0.69), specular=0)
    box("floor", material("parquet", (0.45, 0.27, 0.14), roughness=0.5),
        (-x - WALL, -y - WALL, -WALL), (x + WALL, y + WALL, 0))
    box("ceiling", plaster, (-x - WALL, -y - WALL, HEIGHT), (x + WALL, y + WALL, HEIGHT + WALL))
    box("back wall", plaster, (-x, y, 0), (x, y + WALL, HEIGHT))
    box("front wall", plaster, (-x, -y - WALL, 0), (x, -y, HEIGHT))
    box("right wall", material("terracotta", (0.62, 0.20, 0.10), specular=0),
        (x, -y - WALL, 0), (x + WALL, y + WALL, HEIGHT))
    wall = box("window wall", plaster, (-x - WALL, -y - WALL, 0), (-x, y + WALL, HEIGHT))
    hole = box("window hole", plaster, (-x - 2 * WALL, -0.8, 0.9), (-x + WALL, 0.8, 2.1))
    cut = wall.modifiers.new("Window", "BOOLEAN")
    cut.object = hole
    cut.solver = "EXACT"
    hole.hide_set(True)  # else it is exported, and fills the window
    hole.hide_render = True
    bpy.ops.mesh.primitive_plane_add(size=1, location=(-x - 0.8 * WALL, 0, 1.5), rotation=(0, math.pi / 2, 0))
    pane = named("window", material("daylight", (0.75, 0.88, 1.0), strength=6.0))
    pane.scale = (1.24, 1.64, 1)
    pane.data.materials[0].use_backface_culling = True  # it shines inwards only


def add_furniture():
    oak, slate = material("oak", (0.55, 0.36, 0.18), specular=0), material("slate", (0.10, 0.16, 0.22), specular=0)
    table = joined("table", [box("top", oak, (-0.8, -0.45, 0.71), (0.8, 0.45, 0.75)),
                             *standing(1.5, 0.8, 0.71, 0.03, oak)])
    table.location = TABLE + Vector(table.location)
    chair = joined("chair", [box("seat", slate, (-0.22, -0.22, 0.43), (0.22, 0.22, 0.47)),
                             box("back", slate, (-0.22, 0.18, 0.47), (0.22, 0.22, 0.95)),
                             *standing(0.44, 0.44, 0.43, 0.02, slate)])
    bpy.context.scene.cursor.location = (0, 0, 0)
    bpy.ops.object.origin_set(type="ORIGIN_CURSOR")
    chair.rotation_euler.z = math.radians(200)
    chair.location = (0.35, -0.65, 0)
    y = DEPTH / 2
    box("shelf", oak, (0.5, y - 0.26, 1.3), (2.0, y, 1.34), bevel=0.005)
    at = 0.6
    for k, (thick, high, colour) in enumerate([
            (0.05, 0.26, (0.5, 0.08, 0.06)), (0.04, 0.22, (0.08, 0.25, 0.4)), (0.07, 0.28, (0.1, 0.3, 0.12)),
            (0.05, 0.24, (0.7, 0.55, 0.15)), (0.06, 0.27, (0.25, 0.1, 0.3))]):
        box(f"book {k + 1}", material(f"cloth {k + 1}", colour, specular=0),
            (at, y - 0.2, 1.34), (at + thick, y - 0.02, 1.34 + high))
        at += thick + 0.004


def add_things():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=0.16,
                                         location=TABLE + Vector((-0.45, 0.05, 0.912)))
    named("ball", material("brass", (0.85, 0.63, 0.32), roughness=0.25, metallic=1.0), smooth=True)
    bpy.ops.mesh.primitive_monkey_add(size=0.4, location=TABLE + Vector((0.4, 0.0, 0.851)),
                                      rotation=(math.radians(-35), 0, math.radians(25)))
    suzanne = named("Suzanne", material("ceramic", (0.7, 0.7, 0.66), roughness=0.4), smooth=True)
    suzanne.modifiers.new("Subdivision", "SUBSURF")
    place = Vector((1.9, 1.3, 0))
    brass = bpy.data.materials["brass"]
    bpy.ops.mesh.primitive_cylinder_add(vertices=24, radius=0.15, depth=0.02, location=place + Vector((0, 0, 0.01)))
    foot = named("foot", brass)
    bpy.ops.mesh.primitive_cylinder_add(vertices=12, radius=0.012, depth=0.98, location=place + Vector((0, 0, 0.51)))
    joined("lamp stand", [foot, named("pole", brass)])
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=0.06,
                                         location=place + Vector((0, 0, 1.07)))
    bulb = named("bulb", material("bulb", (1.0, 0.72, 0.42), strength=120.0))
    bulb.data.materials[0].use_backface_culling = True  # its inside is dark
    bpy.ops.mesh.primitive_cone_add(vertices=32, radius1=0.22, radius2=0.14, depth=0.28, end_fill_type="NOTHING",
                                    location=place + Vector((0, 0, 1.08)))
    shade = named("lamp shade", material("linen", (0.8, 0.74, 0.62), specular=0))
    shade.modifiers.new("Solidify", "SOLIDIFY").thickness = 0.004


def add_camera():
    eye, target = Vector((2.2, -1.75, 1.6)), Vector((-0.3, 0.5, 0.95))
    bpy.ops.object.camera_add(location=eye, rotation=(target - eye).to_track_quat("-Z", "Y").to_euler())
    camera = bpy.context.object
    camera.name = camera.data.name = "Camera"
    camera.data.lens = 22  # millimetres
    scene = bpy.context.scene
    scene.camera = camera
    # glTF's field of view is vertical: it follows from the lens and this shape of the picture.
    scene.render.resolution_x, scene.render.resolution_y = 360, 270


bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.unit_settings.system = "METRIC"
add_shell()
add_furniture()
add_things()
add_camera()
after = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
bpy.ops.export_scene.gltf(filepath=after[0] if after else "room.glb", export_format="GLB", export_cameras=True,
                          export_apply=True, export_yup=True, use_visible=True,
                          export_texcoords=False)  # no texture needs them
