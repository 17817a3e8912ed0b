/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep mesh: what a mesh is like, built-in meshes, OBJ out.
 */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "file.h"
#include "mesh_info.h"
#include "mesh_source.h"
#include "obj.h"
#include "options.h"
#include "shape.h"

static const char SOURCES[] = "A mesh is an OBJ file or shape:NAME[:SIZE[:SEED]].\n";

/* --- mesh info ----------------------------------------------------------------------------------
 */

/* "3: 12  4: 384" over as many lines as it takes. */
static void print_histogram(const char *name, const uint32_t *bin) {
    int column = printf("%-12s", name);
    for (int i = 0; i < HS_INFO_BINS; i++)
        if (bin[i]) {
            if (column > 66) {
                printf("\n");
                column = printf("%-12s", "");
            }
            column += printf(" %d: %u ", i, bin[i]);
        }
    printf("\n");
}

/* "creases  1: 4  forever: 12": how many edges or vertices are sharp for so many levels. */
static void print_sharp(const char *name, const uint32_t count[HS_SHARP_INFINITE + 1]) {
    bool any = false;
    for (uint32_t s = 1; s <= HS_SHARP_INFINITE; s++) {
        if (count[s] == 0) continue;
        if (!any) printf("%-12s", name);
        any = true;
        if (s == HS_SHARP_INFINITE)
            printf(" for ever: %u ", count[s]);
        else
            printf(" %u: %u ", s, count[s]);
    }
    if (any) printf("\n");
}

static bool print_info(const char *source, bool round_sharpness, hs_error *err) {
    hs_mesh mesh;
    hs_mesh_info info;
    if (!hs_mesh_open(&mesh, source, round_sharpness, false, err)) return false;
    const bool good = hs_mesh_measure(&info, &mesh, err);
    hs_mesh_free(&mesh);
    if (!good) return false;
    printf("%s\n", source);
    printf("%-12s %u vertices, %u faces, %u edges\n", "counts", info.vertices, info.faces,
           info.edges);
    print_histogram("sides", info.sides);
    print_histogram("valence", info.valence);
    if (info.boundary_edges)
        printf("%-12s %u edges in %u loop%s\n", "boundary", info.boundary_edges,
               info.boundary_loops, info.boundary_loops == 1 ? "" : "s");
    else
        printf("%-12s none: closed\n", "boundary");
    print_sharp("creases", info.creases);
    print_sharp("corners", info.corners);
    printf("%-12s %u component%s, Euler characteristic %d\n", "topology", info.components,
           info.components == 1 ? "" : "s", info.euler);
    for (int i = 0; i < 4; i++)
        if (i < 3 || info.lowest[3] != 1 || info.highest[3] != 1)
            printf("%-12s %c: %g to %g\n", i == 0 ? "box" : "", "xyzw"[i], (double)info.lowest[i],
                   (double)info.highest[i]);
    return true;
}

static int run_info(int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "mesh info",
        "MESH...",
        1,
        -1,
        "Says what meshes are like, or what is wrong with them",
        "sides: faces by their number of sides; valence: vertices by their number of faces;\n"
        "creases, corners: sharp edges and vertices, by how many levels they stay so.\n"
        "A MESH is an OBJ file or shape:NAME[:SIZE[:SEED]].\n\n"
        "  halfstep mesh info shape:hand\n  halfstep mesh info models/*.obj\n"};
    bool round_sharpness = false;
    const hs_option option[] = {{"round-sharpness", 0, HS_OPTION_FLAG, NULL, &round_sharpness, 0, 0,
                                 NULL, "round fractions of a sharpness, halves up"},
                                {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    /* A bad mesh does not keep the others from being shown. */
    int code = HS_EXIT_OK;
    for (int i = operand; i < argc; i++) {
        if (i > operand) printf("\n");
        if (print_info(argv[i], round_sharpness, err)) continue;
        fflush(stdout);
        fprintf(stderr, "halfstep: %s\n", err->text);
        code = err->code;
        err->text[0] = 0;
    }
    return code;
}

/* --- mesh list ----------------------------------------------------------------------------------
 */

static int run_list(int argc, char **argv, hs_error *err) {
    static const hs_command command = {"mesh list", "", 0, 0, "Lists the built-in shapes", ""};
    const hs_option option[] = {{0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    for (const hs_shape *s = hs_shapes; s->name; s++) {
        printf("%-12s %s", s->name, s->what);
        if (s->size) printf("; size %u to %u (%u)", s->min_size, s->max_size, s->size);
        printf("\n");
    }
    return HS_EXIT_OK;
}

/* --- mesh make, mesh convert --------------------------------------------------------------------
 */

static int write_mesh(const hs_mesh *mesh, const char *path, hs_error *err) {
    if (!hs_obj_write_mesh(path, mesh, err)) return err->code;
    if (strcmp(path, "/dev/stdout") != 0)
        printf("%s: %u vertices, %u faces\n", path, mesh->vertices, mesh->faces);
    return HS_EXIT_OK;
}

static int run_make(int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "mesh make",
        "NAME",
        1,
        1,
        "Makes a built-in shape, as OBJ, bit for bit the same everywhere",
        "  halfstep mesh make hand -o hand.obj\n"
        "  halfstep mesh make random --size 500 --seed 7 > random.obj\n"
        "`halfstep mesh list` lists the names and sizes.\n"};
    uint32_t size = 0, seed = 1;
    const char *path = "/dev/stdout";
    const hs_option option[] = {
        {"size", 0, HS_OPTION_NUMBER, "N", &size, 0, UINT32_MAX, NULL,
         "of the shape, if it has one"},
        {"seed", 0, HS_OPTION_NUMBER, "N", &seed, 0, UINT32_MAX, NULL, "of a random shape (1)"},
        {"out", 'o', HS_OPTION_TEXT, "FILE", &path, 0, 0, NULL, "file (standard output)"},
        {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    hs_mesh mesh;
    char source[100];
    snprintf(source, sizeof source, "shape:%.40s:%u:%u", argv[operand], size, seed);
    if (!hs_mesh_open(&mesh, source, false, true, err)) return err->code;
    const int code = write_mesh(&mesh, path, err);
    hs_mesh_free(&mesh);
    return code;
}

static int run_convert(int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "mesh convert",
        "MESH FILE",
        2,
        2,
        "Reads a mesh, checks it, and writes it as plain OBJ: v, f and t lines alone",
        "Reading the result gives the same mesh, bit for bit.\n\n"
        "  halfstep mesh convert scan.obj clean.obj\n"};
    bool round_sharpness = false;
    const hs_option option[] = {{"round-sharpness", 0, HS_OPTION_FLAG, NULL, &round_sharpness, 0, 0,
                                 NULL, "round fractions of a sharpness, halves up"},
                                {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    hs_mesh mesh;
    if (!hs_mesh_open(&mesh, argv[operand], round_sharpness, false, err)) return err->code;
    const int code = write_mesh(&mesh, argv[operand + 1], err);
    hs_mesh_free(&mesh);
    return code;
}

/* --- mesh ---------------------------------------------------------------------------------------
 */

int hs_command_mesh(int argc, char **argv, hs_error *err) {
    static const char *const name[] = {"info", "list", "make", "convert", NULL};
    static int (*const run[])(int, char **, hs_error *) = {run_info, run_list, run_make,
                                                           run_convert};
    if (argc > 1 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)) {
        printf("halfstep mesh info MESH...          what a mesh is like\n"
               "halfstep mesh list                  the built-in shapes\n"
               "halfstep mesh make NAME [-o FILE]   write one of them as OBJ\n"
               "halfstep mesh convert MESH FILE     read, check, write as plain OBJ\n\n"
               "%s"
               "`halfstep mesh info --help`, and so on, explain each by examples.\n",
               SOURCES);
        return HS_EXIT_OK;
    }
    const int which = hs_subcommand("mesh", name, argc, argv, err);
    return which < 0 ? err->code : run[which](argc - 1, argv + 1, err);
}
