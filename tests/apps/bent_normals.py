# Writes scenes whose shading normals are bent (normal maps, vertex normals of coarse meshes) for Weft,
# and renders the same with Cycles: FOLDER/NAME.xml and FOLDER/NAME_cycles.exr.
#   blender -b -noaudio --python bent_normals.py -- FOLDER
# Written for Blender 3.4.
import math
import sys

import bpy
import numpy as np
from mathutils import Vector

if not hasattr(np, "bool"):
    np.bool = bool  # Blender 3.4 asks a newer NumPy for it
FOLDER = sys.argv[sys.argv.index("--") + 1]
WIDTH, HEIGHT, FOV = 120, 90, 40
SUN, SKY = "sun", "sky"


def ball(levels):
    """A unit icosphere: positions, normals, uvs, triangles."""
    g = (1 + 5**0.5) / 2
    points = [np.array(p) / np.linalg.norm(p)
              for s in (-1, 1) for t in (-g, g) for p in ((0, s, t), (s, t, 0), (t, 0, s))]
    triangles = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                p, q, r = points[a], points[b], points[c]
                if max(np.linalg.norm(e) for e in (p - q, q - r, r - p)) < 1.1:
                    outwards = np.dot(np.cross(q - p, r - p), p) > 0
                    triangles.append((a, b, c) if outwards else (a, c, b))
    for _ in range(levels):
        middles = {}

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                sum_of_both = points[a] + points[b]
                points.append(sum_of_both / np.linalg.norm(sum_of_both))
            return middles[key]

        finer = []
        for a, b, c in triangles:
            x, y, z = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, x, z), (b, y, x), (c, z, y), (x, y, z)]
        triangles = finer
    points = np.array(points)
    return points, points, 0.5 + 0.5 * points[:, :2], triangles


def floor():
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float)
    points = np.concatenate([4 * corners, np.full((4, 1), -1.0)], 1)
    return points, np.tile((0.0, 0, 1), (4, 1)), 0.5 + 0.5 * corners, [(0, 1, 2), (0, 2, 3)]


def cone(sides=12):
    points, normals, uvs, triangles = [], [], [], []
    for i in range(sides):
        first = len(points)
        triangles.append((first, first + 1, first + 2))
        for turn, z in ((i, -1), (i + 1, -1), (i + 0.5, 1)):
            c, s = math.cos(2 * math.pi * turn / sides), math.sin(2 * math.pi * turn / sides)
            points.append((c, s, -1) if z < 0 else (0, 0, 1))
            normals.append(np.array((2 * c, 2 * s, 1)) / math.sqrt(5))
            uvs.append((turn / sides, 0.5 * z + 0.5))
    return np.array(points, float), np.array(normals), np.array(uvs), triangles


# Name: mesh, glossy, normal map, lights (towards and strength), camera. All look at the origin, z up.
SCENES = {
    "mapped_floor": (floor(), False, True, {SUN: ((0.95, 0.1, 0.3), 3)}, (0, -6, 1.2)),
    "mapped_floor_at_a_low_angle": (floor(), False, True, {SKY: 1}, (0, -6, 0.3)),
    "mapped_glossy_floor": (floor(), True, True, {SKY: 1, SUN: ((0.3, 0.9, 0.3), 1)}, (0, -6, 0.3)),
    "mapped_ball": (ball(3), False, True, {SKY: 0.1, SUN: ((1, -0.4, 0.3), 3)}, (0, -4.5, 0.4)),
    "coarse_ball": (ball(1), False, False, {SKY: 0.1, SUN: ((1, 0.2, 0.1), 3)}, (0, -4.5, 0.4)),
    "coarse_glossy_ball": (ball(1), True, False, {SKY: 0.5, SUN: ((1, -0.4, 0.3), 1)}, (0, -4.5, 0.4)),
    "cone": (cone(), False, False, {SKY: 0.3, SUN: ((1, -0.3, 0.2), 3)}, (0, -5, 0.6)),
}


def write_normal_map(path, size=512):
    """Round bumps under diagonal ridges, in tangent space."""
    y, x = np.mgrid[0:size, 0:size] / size

    def height(x, y):
        bumps = 0.012 * np.sin(24 * math.pi * x) * np.sin(24 * math.pi * y)
        return bumps + 0.008 * np.abs(np.sin(12 * math.pi * (x + y)))

    step = 1 / size
    slope_x = (height(x + step, y) - height(x - step, y)) / (2 * step)
    slope_y = (height(x, y + step) - height(x, y - step)) / (2 * step)
    normal = np.stack([-slope_x, -slope_y, np.ones_like(x)], 2)
    normal /= np.linalg.norm(normal, axis=2)[:, :, None]
    pixels = np.concatenate([0.5 * normal + 0.5, np.ones((size, size, 1))], 2)
    image = bpy.data.images.new("normals", size, size, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(pixels.astype(np.float32).ravel())
    image.filepath_raw, image.file_format = path, "OPEN_EXR"
    image.save()


def write_ply(path, points, normals, uvs, triangles):
    with open(path, "w") as out:
        out.write(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n")
        out.writelines(f"property float {p}\n" for p in "x y z nx ny nz s t".split())
        out.write(f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
        for row in np.concatenate([points, normals, uvs], 1):
            out.write(" ".join("%.9g" % v for v in row) + "\n")
        out.writelines("3 %d %d %d\n" % t for t in triangles)


def write_weft(name, glossy, mapped, lights, camera):
    # As parts of a mixture these have soft borders; by themselves they are lightwave's.
    bsdf = ('<bsdf type="roughconductor" reflectance="0.8" roughness="0.4"/>' if glossy else
            '<bsdf type="diffuse" albedo="0.8"/>')
    shades = f'<bsdf type="mix" amount="0">{bsdf}{bsdf}</bsdf>'
    if mapped:
        shades += '<texture name="normal" type="image" filename="normals.exr" colorSpace="lin_rec709"/>'
    shine = ""
    if SUN in lights:
        shine += '<light type="directional" direction="%g,%g,%g" intensity="%g"/>' % (
            *lights[SUN][0], lights[SUN][1])
    if SKY in lights:
        shine += f'<light type="envmap"><texture type="constant" value="{lights[SKY]}"/></light>'
    with open(f"{FOLDER}/{name}.xml", "w") as out:
        out.write(f"""<integrator type="path" depth="6">
  <sampler type="sobol" count="256"/><image id="{name}"/>
  <scene>
    <camera type="perspective" width="{WIDTH}" height="{HEIGHT}" fov="{FOV}"><transform>
      <lookat origin="{camera[0]},{camera[1]},{camera[2]}" target="0,0,0" up="0,0,-1"/></transform></camera>
    {shine}
    <instance><shape type="mesh" filename="{name}.ply"/>{shades}</instance>
  </scene>
</integrator>
""")


def add(scene, name, data, towards=None):
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    if towards:
        thing.rotation_mode = "QUATERNION"
        thing.rotation_quaternion = Vector(towards).to_track_quat("Z", "Y")
    return thing


def cycles_material(glossy, mapped, uv_map):
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    bsdf = nodes.new("ShaderNodeBsdfGlossy" if glossy else "ShaderNodeBsdfDiffuse")
    bsdf.inputs["Color"].default_value = (0.8, 0.8, 0.8, 1)
    bsdf.inputs["Roughness"].default_value = 0.4 if glossy else 0
    if glossy:
        bsdf.distribution = "GGX"
    if mapped:
        image = nodes.new("ShaderNodeTexImage")
        image.image = bpy.data.images.load(f"{FOLDER}/normals.exr")
        image.image.colorspace_settings.name = "Non-Color"
        bump = nodes.new("ShaderNodeNormalMap")
        bump.uv_map = uv_map
        links.new(image.outputs[0], bump.inputs["Color"])
        links.new(bump.outputs[0], bsdf.inputs["Normal"])
    links.new(bsdf.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return material


def render_cycles(name, mesh, glossy, mapped, lights, camera):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    points, normals, uvs, triangles = mesh
    data = bpy.data.meshes.new(name)
    data.from_pydata(points.tolist(), [], [tuple(t) for t in triangles])
    for polygon in data.polygons:
        polygon.use_smooth = True
    layer = data.uv_layers.new()
    layer.data.foreach_set("uv", np.array([uvs[i] for t in triangles for i in t], np.float32).ravel())
    data.use_auto_smooth, data.auto_smooth_angle = True, math.pi
    data.normals_split_custom_set_from_vertices([tuple(n) for n in normals.tolist()])
    data.materials.append(cycles_material(glossy, mapped, layer.name))
    add(scene, name, data)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    sky = scene.world.node_tree.nodes["Background"]
    sky.inputs[0].default_value = (1, 1, 1, 1)
    sky.inputs[1].default_value = lights.get(SKY, 0)
    if SUN in lights:
        sun = bpy.data.lights.new("sun", "SUN")
        sun.energy, sun.angle = lights[SUN][1], 0
        add(scene, "sun", sun, lights[SUN][0])
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit, lens.angle = "HORIZONTAL", math.radians(FOV)
    scene.camera = add(scene, "camera", lens, camera)
    scene.camera.location = camera
    to = scene.render
    to.engine, to.resolution_percentage = "CYCLES", 100
    to.resolution_x, to.resolution_y = WIDTH, HEIGHT
    c = scene.cycles
    c.samples, c.use_adaptive_sampling, c.use_denoising = 256, False, False
    c.pixel_filter_type, c.sample_clamp_indirect, c.blur_glossy = "BOX", 0, 0
    c.max_bounces = c.diffuse_bounces = c.glossy_bounces = 4
    to.image_settings.file_format, to.image_settings.color_depth = "OPEN_EXR", "32"
    to.filepath = f"{FOLDER}/{name}_cycles.exr"
    bpy.ops.render.render(write_still=True)


write_normal_map(f"{FOLDER}/normals.exr")
for name, (mesh, *rest) in SCENES.items():
    write_ply(f"{FOLDER}/{name}.ply", *mesh)
    write_weft(name, *rest)
    render_cycles(name, mesh, *rest)
