# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar."""
import bpy

from . import settings


class Panel(bpy.types.Panel):
    bl_idname, bl_label, bl_category = "VIEW3D_PT_furrow", "Furrow", "Furrow"
    bl_space_type, bl_region_type = "VIEW_3D", "UI"

    def draw(self, context):
        layout, s = self.layout, context.scene.furrow
        if not settings.program(context):
            layout.label(text="The program furrow is not found:", icon="ERROR")
            layout.label(text="name its path in the add-on's preferences")
        lines = layout.column(align=True)
        lines.prop(s, "lines_from")
        if s.lines_from == "PENCIL":
            lines.prop(s, "pencil")
        lines.prop(s, "height")
        lines.prop(s, "width")
        lines.prop(s, "maps")
        if s.maps:
            lines.prop(s, "texels")
        layout.operator("furrow.wrinkle")
        cloth = layout.column(align=True)
        cloth.prop(s, "fabric")
        cloth.prop(s, "body")
        cloth.prop(s, "made_for")
        if context.object and context.object.type == "MESH":
            for group in ("pins", "attach", "free"):
                cloth.prop_search(s, group, context.object, "vertex_groups")
        layout.operator("furrow.settle")
        layout.operator("furrow.keep")
        layout.operator("furrow.fit")


classes = (Panel,)
