// The assets that drawing the scene reads and writes.
#include <stdlib.h>

#include "core/base/log.h"
#include "core/techniques/cartoon/instance.h"

// Packs a material into a word: red, green, blue and gloss, from the lowest byte on.
static uint32_t packed(const struct diorama_material *m)
{
    const float parts[4] = {m->r, m->g, m->b, m->shine};
    uint32_t word = 0;
    for (int i = 0; i < 4; i++)
        word |= (uint32_t)((double)parts[i] * 255 + 0.5) << 8 * i;
    return word;
}

static void add_mesh(struct cartoon *c)
{
    struct rg_instance *i = &c->base;
    const struct diorama *d = c->diorama;
    const struct rg_mesh *mesh = d->mesh;
    uint32_t *normals = rg_mesh_pack_normals(mesh), palette[1 + DIORAMA_MATERIALS] = {0};
    for (int k = 0; k < d->material_count; k++)
        palette[1 + k] = packed(&d->palette[k]);
    i->has_failed |= !normals;
    rg_add_buf(i, "positions", 3 * (int64_t)mesh->vertex_count, mesh->positions);
    rg_add_buf(i, "normals", mesh->vertex_count, normals);
    rg_add_buf(i, "indices", 3 * (int64_t)mesh->face_count, mesh->indices);
    rg_add_buf(i, "materials", mesh->face_count, d->materials);
    rg_add_buf(i, "palette", d->material_count + 1, palette);
    free(normals);
}

// Without outlines the styles get one texel without ink; without hatching, no strokes.
static void add_drawing(struct cartoon *c)
{
    struct rg_instance *i = &c->base;
    const struct rg_image_desc *target = &i->target->desc;
    const int style = c->settings.style;
    const bool outlined = style != CARTOON_GOOCH && style != CARTOON_TONED;
    struct rg_edges edges = {0};
    c->ink = rg_add_image(i, "ink", RG_D32F, outlined ? target->width : 1,
                          outlined ? target->height : 1);
    const float none = 1;
    i->has_failed |= !c->ink || !rg_image_clear(c->ink->image, &none);
    if (outlined) {
        i->has_failed |= !rg_mesh_edges(c->diorama->mesh, &edges);
        c->edge_count = edges.count;
        rg_add_buf(i, "edges", (int64_t)edges.count * RG_EDGE_WORDS, edges.words);
        rg_edges_free(&edges);
    }
    if (style == CARTOON_HATCHING)
        cartoon_add_strokes(c);
}

// If collisions need no faces, the face map is one empty texel.
static void add_maps(struct cartoon *c)
{
    struct rg_instance *i = &c->base;
    const struct rg_image_desc *target = &i->target->desc;
    const int width = target->width, height = target->height;
    const bool asks = c->settings.rain.collide == CARTOON_COLLIDE_CORRECT;
    c->normal_map = rg_add_image(i, "normal_map", RG_RGBA16F, width, height);
    c->depth_map = rg_add_image(i, "depth_map", RG_D32F, width, height);
    c->face_map = rg_add_image(i, "face_map", RG_RGBA8, asks ? width : 1, asks ? height : 1);
    c->number_depth = rg_add_image(i, "number_depth", RG_D32F, asks ? width : 1, asks ? height : 1);
}

static void tell(struct cartoon *c)
{
    const struct rg_mesh *mesh = c->diorama->mesh;
    rg_tell_text(&c->base, "model", "%.*s", RG_FACT_SIZE - 1, mesh->name);
    rg_tell_text(&c->base, "model_hash", "%016llx", (unsigned long long)mesh->hash);
    rg_tell(&c->base, "points", mesh->vertex_count);
    rg_tell(&c->base, "triangles", mesh->face_count);
}

bool cartoon_scene_open(struct cartoon *c)
{
    const struct cartoon_settings *s = &c->settings;
    c->diorama = s->scene == CARTOON_MESH ? diorama_of_mesh(s->mesh)
                                          : diorama_create((enum diorama_scene)s->scene);
    if (!c->diorama)
        return false;
    add_mesh(c);
    add_maps(c);
    add_drawing(c);
    tell(c);
    if (!cartoon_look(c, 0))
        return false;
    return !cartoon_is_inside(c->diorama->mesh, c->view.camera.position) ||
           rg_error("camera: its eye is inside of something in the scene; lower zoom, or change "
                    "turn_deg");
}
