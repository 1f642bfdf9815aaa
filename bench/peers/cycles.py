"""Renders one of Weft's scene files with Cycles, so that both are measured on the same picture.

    blender -b -noaudio -t THREADS --python cycles.py -- SCENE.xml OUT.exr SEED

Prints a line "RENDER user SECONDS wall SECONDS": processor time and wall time of the render alone.
Written for Blender 3.4. It reads the part of the scene format that the scenes beside it use: a
perspective camera, rectangles and PLY meshes, diffuse, GGX conductors and smooth dielectrics, area
lights, and one environment image. Anything else stops it with a message.
"""
import math
import os
import resource
import sys
import time
import xml.etree.ElementTree as xml

import bpy
import numpy as np
from mathutils import Matrix, Vector

if not hasattr(np, "bool"):  # Blender's own add-ons ask for the old name
    np.bool = bool


def fail(what):
    sys.exit("cycles.py: expected only what its scenes use, found " + what)


def numbers(text):
    return [float(x) for x in text.split(",")]


# Transforms: as in the file, the first one listed acts first.


def matrix_of(element):
    result = Matrix.Identity(4)
    for step in element if element is not None else ():
        if step.tag == "translate":
            v = numbers(step.get("value"))
            m = Matrix.Translation(v)
        elif step.tag == "scale":
            v = numbers(step.get("value"))
            v = v * 3 if len(v) == 1 else v
            m = Matrix.Diagonal((*v, 1))
        elif step.tag == "rotate":
            m = Matrix.Rotation(math.radians(float(step.get("angle"))), 4, Vector(numbers(step.get("axis"))))
        elif step.tag == "matrix":
            v = numbers(step.get("value"))
            m = Matrix([v[0:4], v[4:8], v[8:12], v[12:16]])
        else:
            fail("<%s> in a transform" % step.tag)
        result = m @ result
    return result


# Meshes


def read_ply(path):
    """Vertices as an array of floats with the names of its columns, and faces as lists of corners."""
    data = open(path, "rb").read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode().split("\n")
    counts = {line.split()[1]: int(line.split()[2]) for line in header if line.startswith("element")}
    columns = [line.split()[2] for line in header if line.startswith("property float")]
    size = counts["vertex"] * len(columns)
    vertices = np.frombuffer(data, np.float32, size, end).reshape(-1, len(columns))
    at, faces, first = end + 4 * size, counts["face"], data[end + 4 * size]
    if len(data) - at == faces * (1 + 4 * first):  # all faces have as many corners
        face = np.dtype([("count", "u1"), ("corners", "<u4", first)])
        return vertices, columns, np.frombuffer(data, face, faces, at)["corners"].tolist()
    corners = []
    for _ in range(faces):
        corners.append(np.frombuffer(data, "<u4", data[at], at + 1).tolist())
        at += 1 + 4 * data[at]
    return vertices, columns, corners


def add_mesh(name, matrix, material, vertices, columns, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices[:, :3].tolist(), [], faces)
    if "s" in columns:
        k = columns.index("s")
        corners = [v for face in faces for v in face]
        mesh.uv_layers.new().data.foreach_set("uv", np.ascontiguousarray(vertices[corners, k : k + 2]).ravel())
    if "nx" in columns:
        k = columns.index("nx")
        mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.pi
        mesh.normals_split_custom_set_from_vertices(vertices[:, k : k + 3].tolist())
    mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    thing.matrix_world = matrix
    bpy.context.scene.collection.objects.link(thing)


RECTANGLE = (
    np.array([[-1, -1, 0, 0, 0], [1, -1, 0, 1, 0], [1, 1, 0, 1, 1], [-1, 1, 0, 0, 1]], np.float32),
    ["x", "y", "z", "s", "t"],
    [[0, 1, 2, 3]],
)


# Materials


def new_nodes(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return material, material.node_tree.nodes, material.node_tree.links


def add_bsdf(nodes, links, bsdf, folder):
    kind = bsdf.get("type")
    if kind == "diffuse":
        node = nodes.new("ShaderNodeBsdfDiffuse")
        texture = bsdf.find("texture")
        if texture is None:
            node.inputs["Color"].default_value = (*numbers(bsdf.get("albedo")), 1)
        else:
            image = nodes.new("ShaderNodeTexImage")
            image.image = bpy.data.images.load(os.path.join(folder, texture.get("filename")))
            links.new(image.outputs["Color"], node.inputs["Color"])
    elif kind == "roughconductor" and bsdf.get("distribution") == "ggx":
        node = nodes.new("ShaderNodeBsdfGlossy")
        node.distribution = "GGX"
        node.inputs["Color"].default_value = (*numbers(bsdf.get("reflectance")), 1)
        node.inputs["Roughness"].default_value = float(bsdf.get("roughness"))
    elif kind == "dielectric":
        node = nodes.new("ShaderNodeBsdfGlass")
        node.distribution = "SHARP"
        node.inputs["Color"].default_value = (1, 1, 1, 1)
        node.inputs["IOR"].default_value = float(bsdf.get("ior"))
    else:
        fail('<bsdf type="%s">' % kind)
    return node.outputs[0]


def make_material(bsdf, emission, folder):
    """The front of an emitter shines and scatters, its back scatters, as a lambertian emission does."""
    material, nodes, links = new_nodes("material")
    surface = nodes.new("ShaderNodeOutputMaterial").inputs[0]
    scattered = add_bsdf(nodes, links, bsdf, folder)
    if emission is None:
        links.new(scattered, surface)
        return material
    radiance = numbers(emission.get("emission"))
    shine = nodes.new("ShaderNodeEmission")
    shine.inputs["Strength"].default_value = max(radiance)
    shine.inputs["Color"].default_value = (*[x / max(radiance) for x in radiance], 1)
    back = nodes.new("ShaderNodeNewGeometry")
    front_only = nodes.new("ShaderNodeMixShader")
    both = nodes.new("ShaderNodeAddShader")
    links.new(back.outputs["Backfacing"], front_only.inputs[0])
    links.new(shine.outputs[0], front_only.inputs[1])
    links.new(front_only.outputs[0], both.inputs[0])
    links.new(scattered, both.inputs[1])
    links.new(both.outputs[0], surface)
    return material


# The scene


def add_instance(instance, bsdfs, folder):
    shape = instance.find("shape")
    bsdf = instance.find("bsdf")
    if bsdf is None:
        bsdf = bsdfs[instance.find("ref").get("id")]
    material = make_material(bsdf, instance.find("emission"), folder)
    if shape.get("type") == "rectangle":
        mesh = RECTANGLE
    elif shape.get("type") == "mesh":
        mesh = read_ply(os.path.join(folder, shape.get("filename")))
    else:
        fail('<shape type="%s">' % shape.get("type"))
    add_mesh(shape.get("type"), matrix_of(instance.find("transform")), material, *mesh)


def add_environment(light, folder):
    """Weft looks a direction (x, y, z) of the light's space up where Cycles looks up (x, z, -y)."""
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    to_light = matrix_of(light.find("transform")).inverted()
    direction = nodes.new("ShaderNodeTexCoord").outputs["Generated"]
    joined = nodes.new("ShaderNodeCombineXYZ")
    for i, row in enumerate((to_light[0], to_light[2], -to_light[1])):
        product = nodes.new("ShaderNodeVectorMath")
        product.operation = "DOT_PRODUCT"
        product.inputs[1].default_value = row[:3]
        links.new(direction, product.inputs[0])
        links.new(product.outputs["Value"], joined.inputs[i])
    image = nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(os.path.join(folder, light.find("texture").get("filename")))
    image.image.colorspace_settings.name = "Linear"
    background = nodes.new("ShaderNodeBackground")
    links.new(joined.outputs[0], image.inputs[0])
    links.new(image.outputs[0], background.inputs[0])
    links.new(background.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs[0])


def add_camera(camera):
    """Weft's camera looks along its z with y downwards; Blender's looks against z with y upwards."""
    look = camera.find("transform/lookat")
    origin, target, up = (Vector(numbers(look.get(k))) for k in ("origin", "target", "up"))
    forward = (target - origin).normalized()
    right = up.cross(forward).normalized()
    down = forward.cross(right)
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "HORIZONTAL", math.radians(float(camera.get("fov")))
    data.clip_start, data.clip_end = 1e-3, 1e5
    thing = bpy.data.objects.new("camera", data)
    thing.matrix_world = Matrix.Translation(origin) @ Matrix((right, -down, -forward)).transposed().to_4x4()
    scene = bpy.context.scene
    scene.collection.objects.link(thing)
    scene.camera = thing
    scene.render.resolution_x, scene.render.resolution_y = int(camera.get("width")), int(camera.get("height"))


def load(path):
    integrator = xml.parse(path).getroot()
    scene, folder = integrator.find("scene"), os.path.dirname(os.path.abspath(path))
    bsdfs = {b.get("id"): b for b in scene.findall("bsdf")}
    for element in scene:
        if element.tag == "camera":
            add_camera(element)
        elif element.tag == "instance":
            add_instance(element, bsdfs, folder)
        elif element.tag == "light" and element.get("type") == "area":
            add_instance(element.find("instance"), bsdfs, folder)
        elif element.tag == "light" and element.get("type") == "envmap":
            add_environment(element, folder)
        elif element.tag != "bsdf":
            fail("<%s>" % element.tag)
    return integrator


def render(integrator, output, seed):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.seed = int(integrator.find("sampler").get("count")), seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    # Weft counts the vertices of a path, Cycles its indirect bounces.
    for name in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        setattr(cycles, name + "_bounces", int(integrator.get("depth")) - 2)
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
    scene.render.filepath = output
    before, start = resource.getrusage(resource.RUSAGE_SELF), time.time()
    bpy.ops.render.render(write_still=True)
    user = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before.ru_utime
    print("RENDER user %.3f wall %.3f" % (user, time.time() - start))


bpy.ops.wm.read_factory_settings(use_empty=True)
scene_file, output_file, seed_text = sys.argv[sys.argv.index("--") + 1 :]
render(load(scene_file), output_file, int(seed_text))
