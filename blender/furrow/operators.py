# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrinkle, settle, keep, fit: each writes files, lets the program run, and brings what comes of it back as a shape key."""
import filecmp
import json
import os
import tempfile

import bpy
import mathutils
import numpy

from . import colours, files, runs, settings

frame = ["--unit", "m", "--up", "z"]


def folder_of(obj):
    """Where an object's files lie, as long as this Blender runs."""
    path = os.path.join(bpy.app.tempdir or tempfile.gettempdir(), "furrow-" + bpy.path.clean_name(obj.name))
    os.makedirs(path, exist_ok=True)
    return path


def cloth_of(obj):
    """The cloth of the last result, with its lines and rest lengths; None: there is none."""
    path = os.path.join(folder_of(obj), "cloth.ply")
    return path if obj.get("furrow_cloth") and os.path.exists(path) else None


def worn_of(obj):
    """The body that the cloth of the last result settled on, as it stood then; None: it lies as the garment was made."""
    path = os.path.join(folder_of(obj), "worn.obj")
    return path if cloth_of(obj) and os.path.exists(path) else None


class Job:
    """What the operators have in common."""
    bl_options = {"REGISTER"}
    key = ""  # of the shape

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def prepare(self, context):
        """Writes files and returns command lines. Raises runs.Failed."""
        raise NotImplementedError

    def take(self, context, run):
        """Brings the result into the scene."""
        points = files.read_obj_points(os.path.join(self.folder, "shape.obj"))
        if len(points) != len(self.obj.data.vertices):
            raise runs.Failed("the mesh was changed meanwhile; nothing was taken")
        os.replace(os.path.join(self.folder, "next.ply"), os.path.join(self.folder, "cloth.ply"))
        self.obj["furrow_cloth"] = self.key
        show_shape(self.obj, "Furrow " + self.key, files.in_object(points, self.matrix, self.scale))
        colours.colour_tangles(self, run)

    # --- How it goes on ---
    def begin(self, context):
        program = settings.program(context)
        if not program:
            raise runs.Failed("the program furrow is not found: name its path in the add-on's preferences")
        self.obj, self.scene = context.object, context.scene.furrow
        if self.obj.mode == "EDIT":  # what is selected there
            self.obj.update_from_editmode()
        self.folder, self.scale = folder_of(self.obj), context.scene.unit_settings.scale_length
        self.matrix = self.obj.matrix_world.copy()
        if not cloth_of(self.obj):  # of another object that had its name
            self.forget_worn()
        return runs.Run(program, self.folder, self.prepare(context))

    def end(self, context, run):
        if self.obj.mode == "EDIT":  # which would write its own shape over ours
            bpy.ops.object.mode_set(mode="OBJECT")
        self.take(context, run)
        for line in run.warnings:
            self.report({"WARNING"}, line)
        self.report({"INFO"}, "Furrow: " + self.key + " is done")

    def execute(self, context):
        try:
            run = self.begin(context)
            run.wait()
            self.end(context, run)
        except runs.Failed as e:
            self.report({"ERROR"}, str(e))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        try:
            self.run = self.begin(context)
        except runs.Failed as e:
            self.report({"ERROR"}, str(e))
            return {"CANCELLED"}
        self.timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.run.stop()
            return self.over(context, "CANCELLED", "stopped; nothing was changed")
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            if not self.run.poll():
                context.window_manager.progress_update(100 * self.run.share)
                context.workspace.status_text_set("Furrow: %s, %.0f %% (Esc stops it)" % (self.run.what or "working", 100 * self.run.share))
                return {"PASS_THROUGH"}
            self.end(context, self.run)
        except runs.Failed as e:
            self.report({"ERROR"}, str(e))
            return self.over(context, "CANCELLED")
        return self.over(context, "FINISHED")

    def over(self, context, how, words=""):
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        if words:
            self.report({"INFO"}, "Furrow: " + words)
        return {how}

    # --- Files ---
    def write_garment(self):
        points = files.in_world(files.coordinates(self.obj.data), self.matrix, self.scale)
        files.write_obj(os.path.join(self.folder, "garment.obj"), self.obj.data, points)

    def write_posed(self, context, figure, name):
        """A body as it stands in the frame that is shown."""
        posed = figure.evaluated_get(context.evaluated_depsgraph_get())
        mesh = posed.to_mesh()
        flat = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float64)
        mesh.vertices.foreach_get("co", flat)
        files.write_obj(os.path.join(self.folder, name), mesh, files.in_world(flat.reshape(-1, 3), posed.matrix_world, self.scale))
        posed.to_mesh_clear()

    def write_body(self, context):
        if not self.scene.body:
            return []
        if self.scene.body == self.obj:
            raise runs.Failed("the body is the garment itself; choose what wears it")
        self.write_posed(context, self.scene.body, "body.obj")
        return ["--body", "body.obj"]

    def made_for(self, context):
        """Whom the cloth lies about, if it is to be brought to the body; after write_body()."""
        if not self.scene.made_for:
            return []
        if self.scene.made_for == self.obj:
            raise runs.Failed("'Made for' is the garment itself; choose the body that it lies about")
        worn = worn_of(self.obj)
        if not worn:
            self.write_posed(context, self.scene.made_for, "made_for.obj")
            return ["--made-for", "made_for.obj"]
        there = self.scene.body and filecmp.cmp(worn, os.path.join(self.folder, "body.obj"), shallow=False)
        return [] if there else ["--made-for", "worn.obj"]

    def forget_worn(self):
        worn = os.path.join(self.folder, "worn.obj")
        if os.path.exists(worn):
            os.remove(worn)

    def require_brought(self):
        """Raises runs.Failed where the cloth lies about another body than the one that is chosen."""
        other = self.scene.made_for
        if other and self.scene.body and other != self.scene.body and not worn_of(self.obj):
            raise runs.Failed("the garment lies about %s; settle it on %s first" % (other.name, self.scene.body.name))

    def vertices_of(self, name):
        """Of a vertex group. Raises runs.Failed if there is none."""
        group = self.obj.vertex_groups.get(name)
        if not group:
            raise runs.Failed("%s has no vertex group '%s'" % (self.obj.name, name))
        held = [v.index for v in self.obj.data.vertices if any(g.group == group.index and g.weight > 0.5 for g in v.groups)]
        if not held:
            raise runs.Failed("no vertex has a weight above 0.5 in the group '%s'" % name)
        return held

    def pins(self):
        return ["--pin-vertices", ",".join(map(str, self.vertices_of(self.scene.pins)))] if self.scene.pins else []

    def chosen_parts(self):
        """Parts that ride on other cloth, or do not, whatever is found."""
        words, part = [], files.parts_of(self.obj.data)
        for setting, group in (("attach_parts", self.scene.attach), ("free_parts", self.scene.free)):
            if group:
                names = [files.name_of_part(p) for p in sorted({part[v] for v in self.vertices_of(group)})]
                words += ["--set", "garment.%s=%s" % (setting, json.dumps(names))]
        return words

    def support(self, context):
        words = self.write_body(context) + self.pins()
        if not words:
            raise runs.Failed("nothing holds the garment: choose a body, or a vertex group that is pinned")
        return words

    def input(self):
        """The cloth of the last result, else the mesh as it is."""
        self.write_garment()
        return ["cloth.ply"] if cloth_of(self.obj) else ["garment.obj", *frame]

    def transfer(self):
        return ["transfer", "garment.obj", "next.ply", "-o", "shape.obj", "--json", *frame]


class Wrinkle(Job, bpy.types.Operator):
    """Wrinkles the garment along the lines, and shows it as a shape key"""
    bl_idname, bl_label, key = "furrow.wrinkle", "Wrinkle", "wrinkled"

    def line(self, name, keys, closed, **where):
        stroke = {"name": name, **keys, **where}
        if self.scene.width > 0 and "gather" not in keys:
            stroke["width"] = self.scene.width * self.scale
        return {**stroke, "closed": True} if closed else stroke

    def lines(self):
        if self.scene.lines_from == "EDGES":
            edges = [tuple(e.vertices) for e in self.obj.data.edges if e.select]
            if not edges:
                raise runs.Failed("no edge of %s is selected" % self.obj.name)
            return [self.line("edges %d" % (i + 1), {"height": self.scene.height * self.scale}, closed, vertices=path)
                    for i, (path, closed) in enumerate(files.chains(edges))]
        if not self.scene.pencil:
            raise runs.Failed("choose the Grease Pencil object with the strokes")
        strokes = []
        for layer, points, closed in files.pencil_strokes(self.scene.pencil):
            if len(points) < 2:
                continue
            keys = files.line_of_layer(layer, self.scene.height * self.scale)
            at = files.in_world(numpy.array([tuple(p) for p in points]), self.scene.pencil.matrix_world, self.scale)
            strokes.append(self.line("%s %d" % (layer, len(strokes) + 1), keys, closed, points=at.tolist()))
        if not strokes:
            raise runs.Failed("%s has no strokes in the frame that is shown" % self.scene.pencil.name)
        return strokes

    def prepare(self, _context):
        self.write_garment()
        files.write_strokes(os.path.join(self.folder, "lines.json"), self.lines())
        commands = [["wrinkle", "garment.obj", "lines.json", "-o", "next.ply", "--json", *frame], self.transfer()]
        if self.scene.maps:
            if not self.obj.data.uv_layers.active:
                raise runs.Failed("a map needs texture coordinates: unwrap %s first" % self.obj.name)
            commands.append(["bake", "shape.obj", "next.ply", "-o", "maps", "--texels", str(self.scene.texels), *frame])
        return commands

    def take(self, context, run):
        super().take(context, run)
        self.forget_worn()  # it lies as it was made again
        if self.scene.maps:
            wire_normal_map(self.obj, os.path.join(self.folder, "maps_normal.png"))


class Settle(Job, bpy.types.Operator):
    """Lets the garment come to rest on the body, or hung from its pins, with the lines that it has"""
    bl_idname, bl_label, key = "furrow.settle", "Settle on body", "settled"

    def prepare(self, context):
        self.on_body = bool(self.scene.body)
        drawn = self.on_body and cloth_of(self.obj) and self.obj["furrow_cloth"] == Wrinkle.key
        job, words = "drape", self.input()
        if drawn:  # from the start, so that a coarse garment is refined before its lines are drawn and keeps its gap
            job, words = "wrinkle", ["garment.obj", "lines.json", "--settle", *frame]
        words += [*self.support(context), *self.made_for(context), *self.chosen_parts(), "--fabric", self.scene.fabric]
        return [[job, *words, "-o", "next.ply", "--json"], self.transfer()]

    def take(self, context, run):
        super().take(context, run)
        if self.on_body:
            os.replace(os.path.join(self.folder, "body.obj"), os.path.join(self.folder, "worn.obj"))


class Keep(Job, bpy.types.Operator):
    """Gives the wrinkled garment the rest state with which its lines hold, and colours it by verdict"""
    bl_idname, bl_label, key = "furrow.keep", "Keep", "kept"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(cloth_of(context.object))

    def prepare(self, context):
        self.require_brought()
        words = self.input()
        return [["keep", *words, *self.support(context), "--fabric", self.scene.fabric, "-o", "next.ply", "--json"], self.transfer()]

    def take(self, context, run):
        super().take(context, run)
        verdicts = json.loads(run.outputs[0])["lines"]
        for line in verdicts:
            self.report({"INFO"}, "%s: %s" % (line.get("name") or line["id"], line["words"]))
        columns = files.read_ply_columns(os.path.join(self.folder, "cloth.ply"))
        shades = {"held": (0.25, 0.66, 0.41), "held with press": (0.94, 0.80, 0.24), "held with struts": (0.95, 0.53, 0.24),
                  "lowered": (0.27, 0.47, 0.86), "may hold": (0.63, 0.35, 0.82), "cannot hold": (0.77, 0.16, 0.20), "not known": (0.59, 0.59, 0.59)}
        of_line = {line["id"]: shades.get(line["verdict"], (0.8, 0.8, 0.8)) for line in verdicts}
        shown = numpy.array([of_line.get(int(i), (0.8, 0.8, 0.8)) for i in columns["line"]]) if "line" in columns else None
        if shown is not None:
            colours.colour_by_nearest(self, columns, shown, "Furrow verdict")


class Fit(Job, bpy.types.Operator):
    """Tells how the settled garment fits, and colours it by its distance to the body"""
    bl_idname, bl_label, key = "furrow.fit", "Fit", "fit"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(cloth_of(context.object)) and bool(context.scene.furrow.body)

    def prepare(self, context):
        self.require_brought()
        self.write_body(context)
        return [["fit", "cloth.ply", "--body", "body.obj", "--colour", "distance", "-o", "fit.ply"]]

    def take(self, context, run):
        columns = files.read_ply_columns(os.path.join(self.folder, "fit.ply"))
        shown = numpy.stack([columns[c] for c in ("red", "green", "blue")], axis=1) / 255.0
        colours.colour_by_nearest(self, columns, shown, "Furrow fit")
        for line in run.outputs[0].splitlines():
            if not line.startswith(("written:", "next:")):
                self.report({"INFO"}, line)


def show_shape(obj, name, points):
    """A shape key of that name with these coordinates, which alone of ours is shown."""
    if not obj.data.shape_keys:
        obj.shape_key_add(name="Basis", from_mix=False)
    keys = obj.data.shape_keys.key_blocks
    key = keys.get(name) or obj.shape_key_add(name=name, from_mix=False)
    key.data.foreach_set("co", numpy.ascontiguousarray(points, dtype=numpy.float32).ravel())
    for other in keys:
        if other.name.startswith("Furrow "):
            other.value = 1 if other == key else 0
    obj.active_shape_key_index = keys.find(key.name)
    obj.data.update()


def wire_normal_map(obj, path):
    """The map goes to the normal of each material's shader, where nothing is wired to it yet, or a map of ours is."""
    image = bpy.data.images.load(path)
    image.name = obj.name + " furrow normal"
    image.colorspace_settings.name = "Non-Color"
    image.pack()
    if not any(slot.material for slot in obj.material_slots):
        material = bpy.data.materials.new(obj.name)
        material.use_nodes = True
        obj.data.materials.append(material)
    for material in {slot.material for slot in obj.material_slots if slot.material}:
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        shader = next((n for n in nodes if n.type == "BSDF_PRINCIPLED"), None)
        if not shader:
            continue
        for old in [n for n in nodes if n.get("furrow")]:
            nodes.remove(old)
        if shader.inputs["Normal"].is_linked:
            continue
        texture, bump = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeNormalMap")
        texture["furrow"] = bump["furrow"] = True
        texture.image = image
        texture.location, bump.location = shader.location + mathutils.Vector((-600, -300)), shader.location + mathutils.Vector((-250, -300))
        links.new(texture.outputs["Color"], bump.inputs["Color"])
        links.new(bump.outputs["Normal"], shader.inputs["Normal"])


classes = (Wrinkle, Settle, Keep, Fit)
