"""Which extensions of glTF are applied, which leave the shape alone, and which are refused.

Source: Khronos, glTF 2.0 extension registry, and the specification of each extension.
"""

from __future__ import annotations

from collections.abc import Iterator

from reference_tracer.camera_files.gltf_file import VISIBILITY
from reference_tracer.files.checked_json import Content
from reference_tracer.scene import SceneError

INSTANCING = "EXT_mesh_gpu_instancing"
COMPRESSED = frozenset(
    {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}
)
APPLIED_BY_BLENDER = COMPRESSED | {INSTANCING, "KHR_mesh_quantization"}
_LEVELS = "MSFT_lod"  # the node itself is the finest level, and is what is traced
# Of materials, textures, lights, animations and data about data. An extension that moves, adds or
# hides anything must not stand here.
NO_SHAPE = frozenset(
    {
        "ADOBE_materials_clearcoat_specular",
        "ADOBE_materials_clearcoat_tint",
        "ADOBE_materials_thin_transparency",
        "AGI_stk_metadata",
        "EXT_instance_features",
        "EXT_lights_ies",
        "EXT_lights_image_based",
        "EXT_mesh_features",
        "EXT_structural_metadata",
        "EXT_texture_avif",
        "EXT_texture_webp",
        "FB_geometry_metadata",
        "GODOT_single_root",
        "KHR_animation_pointer",
        "KHR_lights_punctual",
        "KHR_materials_anisotropy",
        "KHR_materials_clearcoat",
        "KHR_materials_diffuse_transmission",
        "KHR_materials_dispersion",
        "KHR_materials_emissive_strength",
        "KHR_materials_ior",
        "KHR_materials_iridescence",
        "KHR_materials_pbrSpecularGlossiness",
        "KHR_materials_sheen",
        "KHR_materials_specular",
        "KHR_materials_transmission",
        "KHR_materials_unlit",
        "KHR_materials_variants",
        "KHR_materials_volume",
        "KHR_materials_volume_scatter",
        "KHR_node_hoverability",
        "KHR_node_selectability",
        "KHR_techniques_webgl",
        "KHR_texture_basisu",
        "KHR_texture_transform",
        "KHR_xmp",
        "KHR_xmp_json_ld",
        "MSFT_packing_normalRoughnessMetallic",
        "MSFT_packing_occlusionRoughnessMetallic",
        "MSFT_texture_dds",
        "NV_materials_mdl",
    }
)


def unknown_extensions(content: Content) -> list[str]:
    """Return the extensions that a file uses and nobody knows.

    Raises
    ------
    SceneError
        If it cannot be read rightly without one of them.
    """
    known = NO_SHAPE | APPLIED_BY_BLENDER | {VISIBILITY, _LEVELS}
    required = [str(name) for name in content.get("extensionsRequired", [])]
    if unknown := [name for name in required if name not in known]:
        raise SceneError(
            f"it requires {', '.join(unknown)[:99]}, which Reference Tracer does not apply: "
            "export it without"
        )
    used = dict.fromkeys((*map(str, content.get("extensionsUsed", [])), *present(content)))
    return [name for name in used if name not in known]


def present(content: Content) -> Iterator[str]:
    """Yield the extensions that objects of the file hold, listed or not."""
    waiting: list[object] = [content]
    while waiting:
        value = waiting.pop()
        if isinstance(value, list):
            waiting += [item for item in value if isinstance(item, list | dict)]
        elif isinstance(value, dict):
            extensions = value.get("extensions")
            if isinstance(extensions, dict):
                yield from extensions
            # What an extension or the user's extras hold is theirs.
            own = ("extensions", "extras")
            waiting += [v for k, v in value.items() if k not in own and isinstance(v, list | dict)]
