#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <string.h>
#include <strings.h>

#include "core/scene/mesh/importer/importer.h"

static bool refuse_for_assimp(struct import *import, const char *error)
{
    if (strstr(error, "bad_alloc"))
        return import_refuse(import,
                             "Assimp takes more memory for it than the %lld GB that it "
                             "may; decimate it first",
                             (long long)(RG_IMPORT_MAX_MEMORY_BYTES >> 30));
    return import_refuse(import,
                         "Assimp cannot read it (%s); use a sound OBJ, PLY, STL, glTF, 3DS or OFF "
                         "file",
                         error);
}

bool import_load(struct import *import)
{
    int64_t claimed = -1;
    if (!strcasecmp(import->extension, "off") && !import_off_as_obj(import))
        return false;
    if (!import_check_claim(import, &claimed))
        return false;
    struct aiFileIO files = import_files(import);
    const struct aiScene *scene = import->scene = aiImportFileEx(import->name, 0, &files);
    if (!scene)
        return refuse_for_assimp(import, aiGetErrorString());
    if (!import_check_scene(import, scene))
        return false;
    const int64_t polygons = import_count_polygons(scene);
    if (polygons < claimed)
        return import_refuse(import,
                             "only %lld of the %lld faces that its header promises could be "
                             "read; it is cut short or unusual: export it again, as triangles",
                             (long long)polygons, (long long)claimed);
    scene = import->scene = aiApplyPostProcessing(scene, aiProcess_Triangulate);
    if (!scene)
        return import_refuse(import, "Assimp cannot triangulate it; export triangles");
    return import_check_scene(import, scene) && import_gather(import, scene);
}
