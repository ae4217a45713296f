# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user sets: in the sidebar, and the program's place in the add-on's preferences."""
import shutil

import bpy

fabrics = ("cotton wool silk denim interlock jersey rib-knit jet-set dots target black-denim ivory-rib brown-ribbon "
           "white-dots camel-ponte gray-interlock red-jet-set polyester-twill polyester-plain wool-twill viscose-twill "
           "elastane-plain cotton-twill").split()


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    program: bpy.props.StringProperty(name="Program", subtype="FILE_PATH", default="furrow",
                                      description="The program furrow, or its path")

    def draw(self, _context):
        self.layout.prop(self, "program")


def program(context):
    """The program's path, or None."""
    addon = context.preferences.addons.get(__package__)
    return shutil.which(addon.preferences.program if addon else "furrow")


class Settings(bpy.types.PropertyGroup):
    lines_from: bpy.props.EnumProperty(name="Lines", items=[
        ("PENCIL", "Grease Pencil", "Strokes of the Grease Pencil object below, in the frame that is shown"),
        ("EDGES", "Selected edges", "Chains of the edges that are selected in the garment")])
    pencil: bpy.props.PointerProperty(name="Strokes", type=bpy.types.Object, description="The Grease Pencil object",
                                      poll=lambda _self, o: o.type in ("GPENCIL", "GREASEPENCIL"))
    height: bpy.props.FloatProperty(name="Height", default=0.02, min=-1, max=1, unit="LENGTH", precision=3,
                                    description="Of a line: > 0 a ridge, < 0 a valley. A layer that is called 'valley' holds "
                                                "valleys, and '12 mm' in its name is its height")
    width: bpy.props.FloatProperty(name="Width", default=0, min=0, max=10, unit="LENGTH", precision=3,
                                   description="Of a line's fold; 0: as its height asks for")
    fabric: bpy.props.EnumProperty(name="Fabric", items=[(f, f, "") for f in fabrics])
    body: bpy.props.PointerProperty(name="Body", type=bpy.types.Object, poll=lambda _self, o: o.type == "MESH",
                                    description="What wears the garment, as it stands in the frame that is shown")
    made_for: bpy.props.PointerProperty(name="Made for", type=bpy.types.Object, poll=lambda _self, o: o.type == "MESH",
                                        description="The body that the garment lies about, if that is another one: Settle "
                                                    "brings it from there to the body, in its own size")
    pins: bpy.props.StringProperty(name="Pins", description="Vertex group of the garment that is held")
    attach: bpy.props.StringProperty(name="Goes along", description="Vertex group: parts with a vertex in it ride on the cloth "
                                                                    "nearest to them (belts, badges), however far off they lie")
    free: bpy.props.StringProperty(name="Hangs freely", description="Vertex group: parts with a vertex in it are cloth of their "
                                                                    "own (scarves), however near other cloth they lie")
    maps: bpy.props.BoolProperty(name="Bake a normal map", default=False,
                                 description="What the mesh is too coarse for goes into a normal map of its materials")
    texels: bpy.props.IntProperty(name="Texels", default=1024, min=16, max=8192)


classes = (Preferences, Settings)
