#include "core/scene/mesh/models.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"

// The folders in which Debian's glmark2-data and libcgal-demo install their models. RG_MODEL_DIR
// has priority.
#define GLMARK2_DIR  "/usr/share/glmark2/models"
#define CGAL_ARCHIVE "/usr/share/doc/libcgal-dev/data.tar.gz"
#define CGAL_FOLDER  "data/meshes/"

// The last three stand in for scans that no package has, with the face counts of Stuppacher and
// Supan's table of scenes.
static const struct rg_model models[] = {
    {"bunny", "bunny.obj", false, 0, 0, NULL},
    {"horse", "horse.3ds", false, 1, 0, NULL}, // Assimp takes z for up in 3DS files
    {"cat", "cat.3ds", false, 1, 0, NULL},
    {"asteroid", "asteroid-high.3ds", false, 0, 0, NULL},
    {"elephant", "refined_elephant.off", true, 0, 0, NULL},
    {"armadillo", "armadillo.off", true, 0, 0, NULL},
    {"diplodocus", "diplodocus.off", true, 0, 0, NULL},
    {"chinese-dragon", "ChineseDragon-10kv.off", true, 0, 0, NULL},
    {"mannequin", "mannequin-devil.off", true, -1, 0, NULL},
    {"dragon", "ChineseDragon-10kv.off", true, 0, 100000, "dragon"},
    {"buddha", "refined_elephant.off", true, 0, 100000, "buddha"},
    {"planck", "mannequin-devil.off", true, -1, 50801, "bust of Max Planck"},
};
enum { MODEL_COUNT = sizeof(models) / sizeof(models[0]) };

const struct rg_model *rg_model_at(int index)
{
    return index >= 0 && index < MODEL_COUNT ? &models[index] : NULL;
}

static const struct rg_model *find_model(const char *name)
{
    for (int i = 0; i < MODEL_COUNT; i++)
        if (!strcmp(models[i].name, name))
            return &models[i];
    return NULL;
}

// --- files ---

// Looks for NAME in the user's folder, in any format, and fills in `path`.
static bool find_own(const char *name, char *path, size_t size)
{
    static const char *const extensions[] = {"obj", "ply", "off", "stl", "gltf", "glb", "3ds"};
    const char *folder = getenv("RG_MODEL_DIR");
    for (size_t i = 0; folder && *folder && i < sizeof(extensions) / sizeof(extensions[0]); i++) {
        const int written = snprintf(path, size, "%s/%s.%s", folder, name, extensions[i]);
        if (written > 0 && (size_t)written < size && !access(path, F_OK))
            return true;
    }
    return false;
}

static struct rg_mesh *read_file(const char *name, const struct rg_model *model)
{
    char path[4096];
    if (access(GLMARK2_DIR, F_OK))
        return rg_error_null("model '%s': %s is absent; install the Debian package glmark2-data, "
                             "or use torus",
                             name, GLMARK2_DIR);
    snprintf(path, sizeof(path), "%s/%s", GLMARK2_DIR, model->file);
    return rg_mesh_read(path, NULL);
}

static struct rg_mesh *read_archived(const char *name, const struct rg_model *model)
{
    char member[512];
    if (access(CGAL_ARCHIVE, F_OK))
        return rg_error_null("model '%s': %s is absent; install the Debian package libcgal-demo "
                             "(where dpkg leaves out /usr/share/doc: make setup), or use torus",
                             name, CGAL_ARCHIVE);
    if (model)
        snprintf(member, sizeof(member), "%s%s", CGAL_FOLDER, model->file);
    else
        snprintf(member, sizeof(member), "%s%.400s.off", CGAL_FOLDER, name);
    return rg_mesh_read(CGAL_ARCHIVE, member);
}

// --- by name ---

// Brings a model to the paper's number of faces, and notes in its name which model it stands in
// for.
static struct rg_mesh *stand_in(struct rg_mesh *mesh, const struct rg_model *model, bool own)
{
    struct rg_mesh *resized = mesh ? rg_mesh_resize(mesh, model->faces) : NULL;
    rg_mesh_destroy(mesh);
    if (!resized || own)
        return resized;
    const size_t length = strlen(resized->name);
    snprintf(resized->name + length, sizeof(resized->name) - length, ", in place of the %s",
             model->stands_for);
    return resized;
}

static void turn_vectors(float *vectors, int count, int quarter_turns)
{
    const float sign = (float)quarter_turns;
    for (int i = 0; i < count; i++) {
        float *v = vectors + 3 * (size_t)i, y = v[1];
        v[1] = -sign * v[2];
        v[2] = sign * y;
    }
}

// Destroys the mesh and returns it turned by one quarter, forward or back.
static struct rg_mesh *turn(struct rg_mesh *mesh, int quarter_turns)
{
    turn_vectors(mesh->positions, mesh->vertex_count, quarter_turns);
    turn_vectors(mesh->normals, mesh->vertex_count, quarter_turns);
    struct rg_mesh *turned = rg_mesh_create(mesh->name, mesh->vertex_count, mesh->face_count,
                                            mesh->positions, mesh->normals, mesh->indices);
    rg_mesh_destroy(mesh);
    return turned;
}

static struct rg_mesh *load_packaged(const char *name, const struct rg_model *model)
{
    if (!model)
        return read_archived(name, NULL);
    struct rg_mesh *mesh = model->in_archive ? read_archived(name, model) : read_file(name, model);
    return mesh && model->quarter_turns ? turn(mesh, model->quarter_turns) : mesh;
}

static struct rg_mesh *load_named(const char *name)
{
    char path[4096];
    const struct rg_model *model = find_model(name);
    const bool own = find_own(name, path, sizeof(path));
    struct rg_mesh *mesh = own ? rg_mesh_read(path, NULL) : load_packaged(name, model);
    return model && model->faces ? stand_in(mesh, model, own) : mesh;
}

struct rg_mesh *rg_mesh_load(const char *name)
{
    if (!*name)
        return rg_error_null("no model is named; use bunny, torus or a file");
    if (!strcmp(name, "sphere"))
        return rg_mesh_make_sphere();
    if (!strcmp(name, "torus"))
        return rg_mesh_make_torus();
    return strpbrk(name, "./") ? rg_mesh_read(name, NULL) : load_named(name);
}

struct rg_mesh *rg_mesh_load_faces(const char *name, int faces)
{
    struct rg_mesh *mesh = rg_mesh_load(name);
    if (!mesh || !faces)
        return mesh;
    struct rg_mesh *resized = rg_mesh_resize(mesh, faces);
    rg_mesh_destroy(mesh);
    return resized;
}
