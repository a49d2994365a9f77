#!/usr/bin/env python3
"""Renders the scenes of this folder with Mitsuba 3: NAME.toml -> NAME.exr.

    pip install mitsuba==3.9.1
    python render.py [NAME ...] [--samples N] [--out FOLDER]

Only what these scenes use is understood; anything else is an error. Bodies whose material is Phong's without
diffuse light and highlight shine by themselves; in Mitsuba they are black bodies with an emitter.
"""

import argparse
import math
import pathlib
import re
import tomllib

import mitsuba as mi
import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
SIZE = (128, 96)
METALS = FOLDER / "../../crates/optics/src/metal/tables.rs"
# Mitsuba asks for waves from 360 to 830 nm; the tables end a little within.
WAVES = (360.0, 830.0)


def color(value, factor=1.0):
    return {"type": "rgb", "value": [part * factor for part in value]}


def gray(value):
    """Daylight of this strength in the spectral variant, a number in the other."""
    if len(set(value)) > 1:
        raise ValueError("the spectral scenes are gray")
    return {"type": "d65", "scale": value[0]}


def emission(value):
    return gray(value) if mi.is_spectral else color(value)


def measured(metal):
    """n and k of a metal by wavelength, straight lines between the points of the program's own tables."""
    table = re.search(rf"{metal.upper()}: [^=]*= &\[(.*?)\n\];", METALS.read_text(), re.S)
    points = [tuple(map(float, row.split(","))) for row in re.findall(r"\[([\d., ]+)\]", table.group(1))]
    points = [(WAVES[0], *points[0][1:])] * (points[0][0] > WAVES[0]) + points
    points += [(WAVES[1], *points[-1][1:])] * (points[-1][0] < WAVES[1])

    def spectrum(column):
        pick = lambda at: ", ".join(str(point[at]) for point in points)
        return {"type": "irregular", "wavelengths": pick(0), "values": pick(column)}

    return spectrum(1), spectrum(2)


def bsdf(material, outside):
    """What a material is in Mitsuba, in a medium of index `outside`."""
    model = material.get("model", "phong")
    alpha = material.get("roughness", 0.0) ** 2
    rough = {"distribution": "ggx", "alpha": alpha} if alpha else {}
    kind = "rough" if alpha else ""
    if model == "matte":
        if material["ambient"] != 0.0:
            raise ValueError("matte bodies are lit by lights only")
        return {"type": "diffuse", "reflectance": color(material["color"])}
    if model == "dielectric":
        return {"type": kind + "dielectric", "int_ior": material["ior"], "ext_ior": outside, **rough}
    if model == "conductor":
        n, k = measured(material["metal"]) if "metal" in material else (
            {"type": "rgb", "value": material[part]} for part in "nk")
        return {"type": kind + "conductor", "eta": n, "k": k, **rough}
    if model == "coated":
        return {"type": kind + "plastic", "diffuse_reflectance": color(material["color"]),
                "int_ior": material.get("ior", 1.5), "ext_ior": 1.0, "nonlinear": True, **rough}
    raise ValueError(model)


def placed(body):
    """The body's frame in the world: R = Rz Ry Rx, then the translation."""
    to_world = mi.ScalarTransform4f().translate(body.get("position", [0.0] * 3))
    turns = body.get("rotation", [0.0] * 3)
    for axis, turn in reversed(list(zip(([1, 0, 0], [0, 1, 0], [0, 0, 1]), turns))):
        to_world = to_world @ mi.ScalarTransform4f().rotate(axis, turn)
    return to_world


def shapes(body):
    """The parts of a body."""
    to_world = placed(body)
    transform = mi.ScalarTransform4f
    if body["shape"] == "sphere":
        return [{"type": "sphere", "radius": body["radius"], "to_world": to_world}]
    if body["shape"] == "cube":
        size = body["size"] if isinstance(body["size"], list) else [body["size"]] * 3
        return [{"type": "cube", "to_world": to_world @ transform().scale([part / 2 for part in size])}]
    if body["shape"] == "cylinder":
        radius, height = body["radius"], body["height"]
        flat = transform().scale([radius, radius, 1.0])
        up, down = transform().rotate([1, 0, 0], -90), transform().rotate([1, 0, 0], 90)
        top = to_world @ transform().translate([0.0, height, 0.0])
        return [
            {"type": "cylinder", "p0": [0, 0, 0], "p1": [0, height, 0], "radius": radius, "to_world": to_world},
            {"type": "disk", "to_world": top @ up @ flat},
            {"type": "disk", "to_world": to_world @ down @ flat},
        ]
    raise ValueError(body["shape"])


def lamp(light):
    """Point or ball. The program's light of intensity I lights a white matte surface that faces it with I/d²."""
    intensity, radius = light["intensity"], light.get("radius", 0.0)
    if light["falloff"] != "inverse-square":
        raise ValueError(light["falloff"])
    if radius == 0.0:
        return {"type": "point", "position": light["position"], "intensity": color([1.0] * 3, math.pi * intensity)}
    return {"type": "sphere", "center": light["position"], "radius": radius,
            "emitter": {"type": "area", "radiance": color([1.0] * 3, intensity / radius**2)}}


def sky(surroundings):
    """What surrounds the bodies. The middle of the program's pictures is at -z, that of Mitsuba's at z."""
    if "picture" in surroundings:
        turn = surroundings.get("rotation", 0.0) + 180.0
        return {"type": "envmap", "filename": str(FOLDER / surroundings["picture"]),
                "scale": surroundings.get("strength", 1.0),
                "to_world": mi.ScalarTransform4f().rotate([0, 1, 0], turn)}
    if any(surroundings["background"]):
        return {"type": "constant", "radiance": emission(surroundings["background"])}
    return None


def picture():
    """Everything around for `surroundings.toml`: hues and two lamps, other in every direction.

    All is smooth: Mitsuba's outermost rows lie at the poles, the program's half a pixel away from them."""
    width, height = 160, 80
    pixels = []
    for row in range(height):
        for column in range(width):
            u, v = (column + 0.5) / width, (row + 0.5) / height
            hue = [0.5 + 0.4 * math.cos(math.tau * (u * turns + shift)) for turns, shift in ((1, 0), (2, 0.3), (3, 0.6))]
            light = [part * (1.2 - v) for part in hue]
            for lamp_u, lamp_v, size, strength in ((0.2, 0.3, 0.05, 6.0), (0.7, 0.2, 0.09, 3.0)):
                near = math.exp(-(math.hypot(2 * (u - lamp_u), v - lamp_v) / size) ** 2)
                light = [part + strength * near for part in light]
            pixels.append(light)
    return np.array(pixels, dtype="float32").reshape(height, width, 3)


def scene_of(document, samples):
    camera, surroundings = document["camera"], document["environment"]
    look = mi.ScalarTransform4f().look_at(camera["position"], camera["target"], [0, 1, 0])
    scene = {
        "type": "scene",
        # Generation 1 is what the camera sees: a path of one segment.
        "integrator": {"type": "path", "rr_depth": 1000, "max_depth": depth_of(document)},
        "sensor": {
            "type": "perspective", "fov": camera["fov"], "fov_axis": "y", "to_world": look,
            "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"},
                     "pixel_format": "rgb", "component_format": "float32"},
            "sampler": {"type": "independent", "sample_count": samples},
        },
        "sky": sky(surroundings),
    }
    if scene["sky"] is None:
        del scene["sky"]
    for number, light in enumerate(document.get("lights", [])):
        scene[f"light-{number}"] = lamp(light)
    outside = 1.0
    for number, body in enumerate(document["bodies"]):
        material = document["materials"][body["material"]]
        parts = {}
        if material.get("model", "phong") == "phong":
            if material["ambient"] != 1.0 or material["diffuse"] != 0.0:
                raise ValueError("bodies of Phong's model shine by themselves only")
            light = [part * ambient for part, ambient in zip(material["color"], surroundings["ambient"])]
            parts["emitter"] = {"type": "area", "radiance": emission(light)}
            parts["bsdf"] = {"type": "diffuse", "reflectance": color([0.0] * 3)}
        else:
            parts["bsdf"] = bsdf(material, outside)
            if "ior" in material and material.get("model") == "dielectric":
                # The next clear body stands in this one.
                outside = material["ior"]
        for part, shape in enumerate(shapes(body)):
            scene[f"body-{number}-{part}"] = {**shape, **parts}
    return scene


def depth_of(document):
    """A light that falls on a surface is a segment more than what the program counts as a generation."""
    return document["tracing"]["generations"] + bool(document.get("lights"))


def render(path, samples, out):
    document = tomllib.loads(path.read_text())
    spectral = any("metal" in material for material in document["materials"].values())
    mi.set_variant("scalar_spectral" if spectral else "scalar_rgb")
    a_pass = min(samples, 128)
    scene = mi.load_dict(scene_of(document, a_pass))
    passes = samples // a_pass
    total = None
    for seed in range(passes):
        image = mi.render(scene, spp=a_pass, seed=seed).numpy().astype("float64")
        total = image if total is None else total + image
    mi.Bitmap((total / passes).astype("float32")).convert(
        mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float16).write(str(out / (path.stem + ".exr")))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="scenes; all without one")
    parser.add_argument("--samples", type=int, default=4096, help="per pixel")
    parser.add_argument("--out", type=pathlib.Path, default=FOLDER, help="where the pictures go")
    options = parser.parse_args()
    mi.set_variant("scalar_rgb")
    mi.Bitmap(picture()).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float16).write(
        str(FOLDER / "surroundings-picture.exr"))
    for path in sorted(FOLDER.glob("*.toml")):
        if not options.names or path.stem in options.names:
            render(path, options.samples, options.out)
            print(path.stem, flush=True)


if __name__ == "__main__":
    main()
