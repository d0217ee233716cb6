#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/scene/mesh/importer/importer.h"
#include "core/scene/mesh/mesh.h"

// A node's placement: rows of a 3x4 matrix, and the limit of nesting.
struct placement {
    double m[3][4];
};
enum { MAX_DEPTH = 256 };

static const struct placement unmoved = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

// --- checks ---

static bool check_mesh(struct import *import, const struct aiScene *scene, unsigned int index)
{
    const struct aiMesh *mesh = scene->mMeshes[index];
    if (mesh->mNumVertices && !mesh->mVertices)
        return import_refuse(import, "mesh %u has no positions; repair the file", index);
    for (unsigned int i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D *p = &mesh->mVertices[i];
        if (!(fabsf(p->x) <= RG_MESH_FARTHEST && fabsf(p->y) <= RG_MESH_FARTHEST &&
              fabsf(p->z) <= RG_MESH_FARTHEST)) // false for NaN, too
            return import_refuse(import,
                                 "vertex %u of mesh %u lies at (%g, %g, %g); coordinates must be "
                                 "numbers up to %g: repair the file",
                                 i, index, (double)p->x, (double)p->y, (double)p->z,
                                 (double)RG_MESH_FARTHEST);
    }
    for (unsigned int i = 0; i < mesh->mNumFaces; i++)
        for (unsigned int k = 0; k < mesh->mFaces[i].mNumIndices; k++)
            if (mesh->mFaces[i].mIndices[k] >= mesh->mNumVertices)
                return import_refuse(import,
                                     "face %u of mesh %u names vertex %u, but there are %u; "
                                     "repair the file",
                                     i, index, mesh->mFaces[i].mIndices[k], mesh->mNumVertices);
    return true;
}

// The number of triangles in a mesh's polygons.
static int64_t count_triangles(const struct aiMesh *mesh)
{
    int64_t count = 0;
    for (unsigned int i = 0; i < mesh->mNumFaces; i++)
        count += mesh->mFaces[i].mNumIndices > 2 ? mesh->mFaces[i].mNumIndices - 2 : 0;
    return count;
}

// Adds up the vertices and faces of all nodes; a mesh counts once for each node that names it.
static bool count_node(struct import *import, const struct aiScene *scene,
                       const struct aiNode *node, int depth, int64_t *vertices, int64_t *faces)
{
    if (depth > MAX_DEPTH)
        return import_refuse(import, "nodes nest more than %d deep; flatten its scene", MAX_DEPTH);
    for (unsigned int i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] >= scene->mNumMeshes)
            return import_refuse(import, "a node names mesh %u, but there are %u; repair the file",
                                 node->mMeshes[i], scene->mNumMeshes);
        const int64_t triangles = count_triangles(scene->mMeshes[node->mMeshes[i]]);
        *vertices += triangles ? scene->mMeshes[node->mMeshes[i]]->mNumVertices : 0;
        *faces += triangles;
    }
    for (unsigned int i = 0; i < node->mNumChildren; i++)
        if (!count_node(import, scene, node->mChildren[i], depth + 1, vertices, faces))
            return false;
    return true;
}

int64_t import_count_polygons(const struct aiScene *scene)
{
    int64_t count = 0;
    for (unsigned int i = 0; i < scene->mNumMeshes; i++)
        count += scene->mMeshes[i]->mNumFaces;
    return count;
}

bool import_check_scene(struct import *import, const struct aiScene *scene)
{
    int64_t vertices = 0, faces = 0;
    for (unsigned int i = 0; i < scene->mNumMeshes; i++)
        if (!check_mesh(import, scene, i))
            return false;
    if (scene->mRootNode && !count_node(import, scene, scene->mRootNode, 0, &vertices, &faces))
        return false;
    if (!import_check_count(import, vertices, faces))
        return false;
    import->reply.vertex_count = (uint32_t)vertices;
    import->reply.face_count = (uint32_t)faces;
    return true;
}

// --- gathering ---

static struct placement place_within(const struct placement *parent, const struct aiMatrix4x4 *m)
{
    const double local[4][4] = {{(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4},
                                {(double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4},
                                {(double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4},
                                {0, 0, 0, 1}};
    struct placement result;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += parent->m[row][k] * local[k][column];
            result.m[row][column] = sum;
        }
    }
    return result;
}

// The matrix of cofactors, which turns normals whatever the placement scales; they need to be
// normalised again. Returns the determinant, which is negative if the placement mirrors.
static double find_cofactors(const double m[3][4], double cofactors[3][3])
{
    double determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            cofactors[i][j] = m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] -
                              m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3];
    for (int j = 0; j < 3; j++)
        determinant += m[0][j] * cofactors[0][j];
    return determinant;
}

static void place_vertices(const struct import *import, const struct aiMesh *mesh,
                           const struct placement *at, float *positions, float *normals)
{
    double cofactors[3][3];
    const double sign = find_cofactors(at->m, cofactors) < 0 ? -1 : 1;
    // STL has one normal a facet, but joined vertices need their own.
    const bool has_normals = mesh->mNormals && strcasecmp(import->extension, "stl") != 0;
    for (size_t i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D *p = &mesh->mVertices[i];
        const struct aiVector3D *n = has_normals ? &mesh->mNormals[i] : NULL;
        for (int c = 0; c < 3; c++) {
            const double *row = at->m[c], *turn = cofactors[c];
            positions[3 * i + (size_t)c] = (float)(row[0] * (double)p->x + row[1] * (double)p->y +
                                                   row[2] * (double)p->z + row[3]);
            normals[3 * i + (size_t)c] =
                n ? (float)(sign * (turn[0] * (double)n->x + turn[1] * (double)n->y +
                                    turn[2] * (double)n->z))
                  : 0.0f;
        }
    }
}

// Appends a mesh; a mirrored one reverses its faces, so that their outside stays outside.
static void append_mesh(struct import *import, const struct aiMesh *mesh,
                        const struct placement *at)
{
    struct rg_import_reply *reply = &import->reply;
    if (!count_triangles(mesh))
        return;
    double unused[3][3];
    const bool mirrored = find_cofactors(at->m, unused) < 0;
    const uint32_t first = reply->vertex_count;
    place_vertices(import, mesh, at, import->positions + 3 * (size_t)first,
                   import->normals + 3 * (size_t)first);
    reply->vertex_count += mesh->mNumVertices;
    for (unsigned int i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        if (face->mNumIndices != 3)
            continue; // a point or a line
        uint32_t *corner = import->indices + 3 * (size_t)reply->face_count++;
        for (int k = 0; k < 3; k++)
            corner[k] = first + face->mIndices[mirrored ? 2 - k : k];
    }
}

static void append_node(struct import *import, const struct aiScene *scene,
                        const struct aiNode *node, const struct placement *parent)
{
    const struct placement at = place_within(parent, &node->mTransformation);
    for (unsigned int i = 0; i < node->mNumMeshes; i++)
        append_mesh(import, scene->mMeshes[node->mMeshes[i]], &at);
    for (unsigned int i = 0; i < node->mNumChildren; i++)
        append_node(import, scene, node->mChildren[i], &at);
}

bool import_gather(struct import *import, const struct aiScene *scene)
{
    struct rg_import_reply *reply = &import->reply;
    const size_t vertices = reply->vertex_count, faces = reply->face_count;
    import->positions = malloc(vertices * 3 * sizeof(float));
    import->normals = malloc(vertices * 3 * sizeof(float));
    import->indices = malloc(faces * 3 * sizeof(uint32_t));
    if (!import->positions || !import->normals || !import->indices)
        return import_refuse(import, "no memory for %zu faces; decimate it first", faces);
    reply->vertex_count = reply->face_count = 0;
    append_node(import, scene, scene->mRootNode, &unmoved);
    return true;
}
