# SPDX-License-Identifier: GPL-3.0-or-later
"""Furrow in Blender: ridge and valley lines drawn by Grease Pencil, or edges of the mesh, wrinkle a garment; it settles
on a body, keeps its lines, and tells how it fits. Each result is a shape key of the mesh as it was. See docs/blender.md."""
bl_info = {
    "name": "Furrow",
    "author": "The Furrow authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Furrow",
    "description": "Cloth that wrinkles where you draw",
    "doc_url": "",
    "category": "Object",
}

import bpy

from . import operators, panel, settings

modules = (settings, operators, panel)


def register():
    for module in modules:
        for one in module.classes:
            bpy.utils.register_class(one)
    bpy.types.Scene.furrow = bpy.props.PointerProperty(type=settings.Settings)


def unregister():
    del bpy.types.Scene.furrow
    for module in reversed(modules):
        for one in reversed(module.classes):
            bpy.utils.unregister_class(one)
