"""usage: blender --background --factory-startup --python bench/dots_in_cycles.py, in a folder with parameters.json
Dots that a projector throws on a desk and on the bottom of a cup with water, by Cycles with shadow caustics. The
parameters are those of bench/dots.pov, with Samples per pixel for its Photons; slide.png is the same. Writes dots.exr
and times.txt: processor time and time passed of the rendering [s]."""
import json
import math
import resource
import time
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

# The paper's cup.
RIM_MM, BOTTOM_MM, INNER_MM, OUTER_MM = 87, 7, 40, 43
AROUND = 256
# Blender's unit is a centimetre here: Cycles cuts off what a caustic adds beyond twice the strength at one unit's distance.
UNITS_PER_MM = 0.1


class Numbers:
    def __init__(self, path):
        vars(self).update({name: Vector(value) if isinstance(value, list) else value
                           for name, value in json.loads(Path(path).read_text()).items()})


def units(vector_mm):
    return Vector(vector_mm) * UNITS_PER_MM


def add_mesh(name, vertices_mm, faces, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([units(vertex) for vertex in vertices_mm], [], faces)
    mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def circle(radius, height, distance):
    angles = (2 * math.pi * i / AROUND for i in range(AROUND))
    return [(radius * math.cos(a), distance + radius * math.sin(a), height) for a in angles]


def material(name, shader, **inputs):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    bsdf = nodes.new(shader)
    for key, value in inputs.items():
        bsdf.inputs[key].default_value = value
    made.node_tree.links.new(bsdf.outputs["BSDF"], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made, bsdf


def diffuse(name, albedo):
    return material(name, "ShaderNodeBsdfDiffuse", Color=(albedo, albedo, albedo, 1))[0]


def add_desk(of):
    half_mm = 1000
    corners = [(x * half_mm, y * half_mm, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    add_mesh("desk", corners, [(0, 1, 2, 3)], diffuse("desk", of.DeskAlbedo))


def add_cup(of):
    """Bottom, inner wall, rim, outer wall: rings of a profile."""
    profile = [(INNER_MM, BOTTOM_MM), (INNER_MM, RIM_MM), (OUTER_MM, RIM_MM), (OUTER_MM, 0)]
    vertices = [vertex for radius, height in profile for vertex in circle(radius, height, of.DistanceMm)]
    faces = [tuple(range(AROUND))]
    for ring in range(len(profile) - 1):
        for i in range(AROUND):
            low, high = ring * AROUND, (ring + 1) * AROUND
            faces.append((low + i, low + (i + 1) % AROUND, high + (i + 1) % AROUND, high + i))
    cup = add_mesh("cup", vertices, faces, diffuse("cup", of.CupAlbedo))
    cup.cycles.is_caustics_receiver = True


def add_water(of):
    """Its surface alone, which reaches into the wall: with a side at the same vertices Cycles would bend the normals."""
    glass, bsdf = material("water", "ShaderNodeBsdfGlass", IOR=of.Index, Roughness=0.0)
    bsdf.distribution = "SHARP"
    level = BOTTOM_MM + of.FillMm
    water = add_mesh("water", circle((INNER_MM + OUTER_MM) / 2, level, of.DistanceMm), [tuple(range(AROUND))], glass)
    water.data.polygons.foreach_set("use_smooth", [True])  # flat ones cast no caustics, even where they are smooth
    water.cycles.is_caustics_caster = True


def add_projector(of):
    """A point of light whose strength is read from the slide where its direction pierces it."""
    lamp = bpy.data.lights.new("projector", "POINT")
    lamp.shadow_soft_size = 0
    lamp.energy = 1000
    lamp.cycles.is_caustics_light = True
    lamp.use_nodes = True
    nodes, links = lamp.node_tree.nodes, lamp.node_tree.links
    direction = nodes.new("ShaderNodeNewGeometry").outputs["Incoming"]

    def calculated(operation, *inputs):
        node = nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, inputs):
            if isinstance(value, bpy.types.NodeSocket):
                links.new(value, socket)
            else:
                socket.default_value = value
        return node.outputs[0]

    def along(axis):
        node = nodes.new("ShaderNodeVectorMath")
        node.operation = "DOT_PRODUCT"
        links.new(direction, node.inputs[0])
        node.inputs[1].default_value = axis
        return node.outputs["Value"]

    def share(axis, first, size):
        on_slide = calculated("DIVIDE", along(axis), along(of.Forward))
        return calculated("DIVIDE", calculated("SUBTRACT", on_slide, first), size)

    at = nodes.new("ShaderNodeCombineXYZ")
    links.new(share(of.Right, of.SlideLeft, of.SlideColumns), at.inputs["X"])
    links.new(calculated("SUBTRACT", 1.0, share(of.Down, of.SlideTop, of.SlideRows)), at.inputs["Y"])
    slide = nodes.new("ShaderNodeTexImage")
    slide.image = bpy.data.images.load(str(Path("slide.png").resolve()))
    slide.image.colorspace_settings.name = "Non-Color"
    slide.extension = "CLIP"
    links.new(at.outputs["Vector"], slide.inputs["Vector"])
    links.new(slide.outputs["Color"], nodes["Emission"].inputs["Strength"])
    thing = bpy.data.objects.new("projector", lamp)
    thing.location = units(of.ProjectorMm)
    bpy.context.collection.objects.link(thing)


def add_camera(of):
    """Blender's camera looks along its -z, with y up."""
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.sensor_width = of.Columns
    camera.lens = of.FocalPx
    thing = bpy.data.objects.new("camera", camera)
    thing.matrix_world = Matrix.Translation(units(of.CameraMm)) @ Matrix(
        (of.Right, -of.Down, -of.Forward)).transposed().to_4x4()
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def set_up_rendering(of):
    scene = bpy.context.scene
    scene.world.use_nodes = False
    scene.world.color = (0, 0, 0)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = of.Columns, of.Rows, 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.filepath = str(Path("dots.exr").resolve())
    cycles.device = "CPU"
    cycles.samples = of.Samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    cycles.light_sampling_threshold = 0
    cycles.caustics_refractive = True
    # Direct light through the surface and back: a caustic counts as a bounce between surfaces.
    cycles.max_bounces = cycles.transmission_bounces = 2
    cycles.diffuse_bounces = 1
    cycles.glossy_bounces = 0


def spent():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime, time.monotonic()


if __name__ == "__main__":
    numbers = Numbers("parameters.json")
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    add_desk(numbers)
    add_cup(numbers)
    add_water(numbers)
    add_projector(numbers)
    add_camera(numbers)
    set_up_rendering(numbers)
    before = spent()
    bpy.ops.render.render(write_still=True)
    Path("times.txt").write_text(" ".join(f"{b - a:.3f}" for a, b in zip(before, spent())) + "\n")
