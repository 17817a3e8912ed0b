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
#include "terminal.h"

/* --- mesh info ----------------------------------------------------------------------------------
 */

enum { NAME_COLUMN = 13 };

/* Adds an entry of a row, "  4: 384", or begins with it a new line of that row. */
static void print_entry(int *column, const char *key, uint32_t count) {
    char text[60];
    const int gap = *column == NAME_COLUMN ? 0 : 2;
    const int length = snprintf(text, sizeof text, "%s: %u", key, count);
    if (*column + gap + length > HS_TERMINAL_COLUMNS)
        *column = printf("\n%*s%s", NAME_COLUMN, "", text) - 1;
    else
        *column += printf("%*s%s", gap, "", text);
}

/* "sides        3: 12  4: 384" over as many lines as it takes. */
static void print_histogram(const char *name, const uint32_t *bin) {
    int column = printf("%-*s", NAME_COLUMN, name);
    char key[20];
    for (int i = 0; i < HS_INFO_BINS; i++) {
        snprintf(key, sizeof key, "%d", i);
        if (bin[i]) print_entry(&column, key, bin[i]);
    }
    printf("\n");
}

/* "creases      1: 4  for ever: 12": how many edges or vertices are sharp for so many levels. */
static void print_sharp(const char *name, const uint32_t count[HS_SHARP_INFINITE + 1]) {
    int column = 0;
    char key[20];
    for (uint32_t s = 1; s <= HS_SHARP_INFINITE; s++) {
        if (count[s] == 0) continue;
        if (!column) column = printf("%-*s", NAME_COLUMN, name);
        snprintf(key, sizeof key, "%u", s);
        print_entry(&column, s == HS_SHARP_INFINITE ? "for ever" : key, count[s]);
    }
    if (column) printf("\n");
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
        hs_print_error(err);
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
        char what[300];
        const int column = printf("%-12s ", s->name);
        snprintf(what, sizeof what, s->size ? "%s; size %u to %u (%u)" : "%s", s->what, s->min_size,
                 s->max_size, s->size);
        hs_print_wrapped(stdout, column, column, what);
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
    static const hs_part part[] = {
        {"info", run_info, "what meshes are like, or what is wrong with them"},
        {"list", run_list, "the built-in shapes"},
        {"make", run_make, "write one of them as OBJ"},
        {"convert", run_convert, "read a mesh, check it, write it as plain OBJ"},
        {0}};
    return hs_part_run("mesh", part, argc, argv, err);
}
