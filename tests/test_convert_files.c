/* SPDX-License-Identifier: Apache-2.0
 *
 * The files of halfstep convert, as other programs see them: Khronos' validator of glTF, Assimp,
 * POV-Ray. What is not installed is skipped, in words.
 */
#include "place.h"

#include <math.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "commands.h"
#include "convert_write.h"
#include "definitions.h"
#include "mesh_source.h"
#include "obj.h"
#include "png_file.h"
#include "refine.h"
#include "render.h"
#include "view.h"

/* --- Running things ----------------------------------------------------------------------------
 */

/* `halfstep convert LINE`, its words apart by single blanks, _ for a blank in a word. */
static int convert(const char *line, hs_error *err) {
    char text[4000], *rest = text, *word[64] = {(char *)"convert", (char *)"--quiet"};
    int words = 2;
    snprintf(text, sizeof text, "%s", with_folder(&place, line));
    while ((word[words] = strsep(&rest, " ")) != NULL)
        for (char *c = word[words++]; *c; c++)
            if (*c == '_') *c = ' ';
    *err = (hs_error){0};
    return hs_command_convert(words, word, err);
}

static void must_convert(const char *line) {
    hs_error err;
    if (convert(line, &err) != HS_EXIT_OK) fail_msg("convert %s: %s", line, err.text);
}

static void expect(int code, const char *line, const char *text) {
    hs_error err;
    const int sent = convert(line, &err);
    if (sent != code || !strstr(err.text, text))
        fail_msg("convert %s: %d instead of %d, or no \"%s\" in: %s", line, sent, code, text,
                 err.text);
}

static int shell(const char *line) {
    const int status = system(with_folder(&place, line));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void needs(const char *program) {
    char line[200];
    snprintf(line, sizeof line, "command -v %s >/dev/null", program);
    if (system(line) == 0) return;
    print_message("skipped: %s is missing\n", program);
    skip();
}

/* --- PLY ----------------------------------------------------------------------------------------
 */

/* What a PLY file of ours holds, read again by the words of its header. */
typedef struct ply {
    uint32_t vertices, faces, places; /* 3 or 4 places, and 3 normals, a vertex */
    bool text;
    double *number; /* 10 a vertex: places (4), normal, colour */
    uint32_t corners, corner[200000], sides[50000], generation[50000];
} ply;

static double read_number(FILE *file, const ply *p, bool byte) {
    double number = 0;
    float single = 0;
    if (p->text)
        assert_int_equal(fscanf(file, "%lf", &number), 1);
    else if (byte)
        number = getc(file);
    else
        assert_int_equal(fread(&single, sizeof single, 1, file), 1);
    return p->text || byte ? number : (double)single;
}

static uint32_t read_index(FILE *file, const ply *p) {
    uint32_t index = 0;
    if (p->text)
        assert_int_equal(fscanf(file, "%u", &index), 1);
    else
        assert_int_equal(fread(&index, sizeof index, 1, file), 1);
    return index;
}

static void read_ply(ply *p, const char *path) {
    *p = (ply){.places = 3};
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char line[200];
    do {
        assert_non_null(fgets(line, sizeof line, file));
        sscanf(line, "element vertex %u", &p->vertices);
        sscanf(line, "element face %u", &p->faces);
        p->text = p->text || strcmp(line, "format ascii 1.0\n") == 0;
        if (strcmp(line, "property float w\n") == 0) p->places = 4;
    } while (strcmp(line, "end_header\n") != 0);
    p->number = calloc(10 * (size_t)p->vertices, sizeof *p->number);
    assert_non_null(p->number);
    for (uint32_t v = 0; v < p->vertices; v++)
        for (uint32_t i = 0; i < 10; i++)
            p->number[10 * v + i] = i == 3 && p->places == 3 ? 1 : read_number(file, p, i >= 7);
    for (uint32_t f = 0; f < p->faces; f++) {
        p->sides[f] = (uint32_t)read_number(file, p, true);
        for (uint32_t i = 0; i < p->sides[f]; i++)
            p->corner[p->corners++] = read_index(file, p);
        p->generation[f] = (uint32_t)read_number(file, p, true);
    }
    if (p->text) assert_int_equal(getc(file), '\n');
    assert_int_equal(getc(file), EOF);
    fclose(file);
}

static void a_ply_says_the_same_in_text_and_in_binary(void **state) {
    (void)state;
    static const char *const space[] = {"object", "ndc", "clip"};
    static ply binary, text;
    for (int i = 0; i < 3; i++) {
        char line[200];
        snprintf(line, sizeof line, "shape:mixed -f 1 -s 2 --space %s -o @/b.ply", space[i]);
        must_convert(line);
        snprintf(line, sizeof line, "shape:mixed -f 1 -s 2 --space %s --text -o @/t.ply", space[i]);
        must_convert(line);
        read_ply(&binary, inside(&place, "b.ply"));
        read_ply(&text, inside(&place, "t.ply"));
        assert_false(binary.text);
        assert_true(text.text);
        assert_int_equal(binary.places, i == 2 ? 4 : 3);
        assert_int_equal(binary.vertices, text.vertices);
        assert_int_equal(binary.faces, text.faces);
        assert_int_equal(binary.corners, text.corners);
        assert_true(binary.faces > 200);
        for (uint32_t k = 0; k < 10 * binary.vertices; k++)
            assert_true((float)binary.number[k] == (float)text.number[k]);
        assert_memory_equal(binary.corner, text.corner, sizeof text.corner);
        assert_memory_equal(binary.sides, text.sides, sizeof text.sides);
        assert_memory_equal(binary.generation, text.generation, sizeof text.generation);
        free(binary.number);
        free(text.number);
    }
}

static void an_obj_and_a_ply_have_the_same_polygons(void **state) {
    (void)state;
    static ply p;
    hs_error err;
    hs_mesh mesh;
    must_convert("shape:random:100:2 -f 2 -s 4 -o @/r.ply");
    must_convert("shape:random:100:2 -f 2 -s 4 -o @/r.obj");
    read_ply(&p, inside(&place, "r.ply"));
    if (!hs_obj_read(&mesh, inside(&place, "r.obj"), false, NULL, &err)) fail_msg("%s", err.text);
    assert_int_equal(mesh.faces, p.faces);
    assert_int_equal(mesh.halfedges, p.corners);
    for (uint32_t c = 0; c < p.corners; c++)
        for (uint32_t i = 0; i < 4; i++)
            assert_true((float)p.number[10 * p.corner[c] + i] ==
                        mesh.position[4 * mesh.origin[c] + i]);
    hs_mesh_free(&mesh);
    free(p.number);
}

/* --- An independent reader ---------------------------------------------------------------------
 */

/* What Assimp has read, written by it as OBJ: sums over all faces of their corners' positions and
 * of their corners. It may order and join vertices as it likes. */
static void sum_obj(const char *path, double sum[3], uint32_t *faces, uint32_t *corners,
                    uint32_t *colored) {
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    static double v[200000][3];
    uint32_t vertices = 0;
    char line[1000];
    *faces = *corners = *colored = 0;
    sum[0] = sum[1] = sum[2] = 0;
    while (fgets(line, sizeof line, file)) {
        double c[3];
        if (strncmp(line, "v ", 2) == 0) {
            double *p = v[vertices++];
            const int numbers =
                sscanf(line, "v %lf %lf %lf %lf %lf %lf", &p[0], &p[1], &p[2], &c[0], &c[1], &c[2]);
            assert_true(numbers >= 3);
            *colored += numbers == 6;
        }
        if (strncmp(line, "f ", 2) != 0) continue;
        ++*faces;
        char *rest = line + 2, *word;
        while ((word = strsep(&rest, " \n")) != NULL) {
            if (!*word) continue;
            ++*corners;
            for (int i = 0; i < 3; i++)
                sum[i] += v[atoi(word) - 1][i];
        }
    }
    fclose(file);
}

static void assert_assimp_reads(const char *file, const char *ours, bool triangles) {
    char line[500];
    double sum[2][3];
    uint32_t faces[2], corners[2], colored[2];
    snprintf(line, sizeof line, "assimp export @/%s @/assimp.obj >@/assimp.log 2>&1", file);
    if (shell(line) != 0) {
        shell("tail -3 @/assimp.log >&2");
        fail_msg("Assimp does not read %s", file);
    }
    sum_obj(inside(&place, "assimp.obj"), sum[0], &faces[0], &corners[0], &colored[0]);
    sum_obj(inside(&place, ours), sum[1], &faces[1], &corners[1], &colored[1]);
    print_message("%s: %u faces, %u corners, %u coloured vertices\n", file, faces[0], corners[0],
                  colored[0]);
    assert_true(colored[0] > 0);
    assert_true(faces[1] > 100);
    if (!triangles) {
        assert_int_equal(faces[0], faces[1]);
        assert_int_equal(corners[0], corners[1]);
        for (int i = 0; i < 3; i++)
            assert_true(fabs(sum[0][i] - sum[1][i]) < 1e-5 * corners[0]);
    } else {
        assert_int_equal(corners[0], 3 * faces[0]);
        assert_int_equal(faces[0], corners[1] - 2 * faces[1]);
    }
    assert_int_equal(unlink(inside(&place, "assimp.obj")), 0);
}

static void assimp_reads_ply_and_gltf(void **state) {
    (void)state;
    needs("assimp");
    /* No convex n-gons here: what is cut has two triangles less than corners. */
    must_convert("shape:pot -f 1 -s 2 -o @/p.obj");
    must_convert("shape:pot -f 1 -s 2 -o @/p.ply");
    must_convert("shape:pot -f 1 -s 2 --text -o @/t.ply");
    must_convert("shape:die -f 2 -s 4 -o @/d.obj");
    must_convert("shape:die -f 2 -s 4 -o @/d.glb");
    must_convert("shape:die -f 2 -s 4 -o @/d.gltf");
    assert_assimp_reads("p.ply", "p.obj", false);
    assert_assimp_reads("t.ply", "p.obj", false);
    assert_assimp_reads("d.glb", "d.obj", true);
    assert_assimp_reads("d.gltf", "d.obj", true);
}

/* --- Khronos' validator ------------------------------------------------------------------------
 */

static void needs_validator(void) {
    needs("node");
    if (access("build/convert/node_modules/gltf-validator", R_OK) == 0) return;
    print_message("skipped: no gltf-validator in build/convert; npm could not be reached\n");
    skip();
}

static const char validate[] = "node tests/gltf/validate.mjs build/convert ";

static int validator_says(const char *files) {
    char line[1000];
    snprintf(line, sizeof line, "%s%s >&2", validate, files);
    return shell(line);
}

static void gltf_files_are_valid(void **state) {
    (void)state;
    needs_validator();
    must_convert("shape:hand -f 2 -s 4 -o @/hand.glb");
    must_convert("shape:random -o @/random.glb");
    must_convert("shape:die -f 2 -s 4 --space ndc -o @/die.glb");
    must_convert("shape:spoon --space clip -o @/spoon.glb");
    must_convert("shape:tetrahedron -f 0 -s 0 -o @/four.gltf");
    must_convert("shape:cube --space clip -o @/a_cube_100%#.gltf");
    assert_int_equal(validator_says("@/hand.glb @/random.glb @/die.glb @/spoon.glb @/four.gltf "
                                    "'@/a cube 100%#.gltf'"),
                     0);
}

static void the_validator_sees_what_is_wrong(void **state) {
    (void)state;
    needs_validator();
    must_convert("shape:cube -o @/cube.gltf");
    assert_int_equal(validator_says("@/cube.gltf"), 0);
    assert_int_equal(shell("sed -i 's/\"min\":\\[-/\"min\":[-1/' @/cube.gltf"), 0);
    assert_int_not_equal(validator_says("@/cube.gltf"), 0);
    assert_int_not_equal(validator_says(""), 0);
}

/* --- POV-Ray ------------------------------------------------------------------------------------
 */

/* What our renderer covers in the view that is in @/views.txt. */
static void draw_view(hs_picture *picture, const char *shape) {
    hs_error err;
    hs_mesh mesh;
    hs_view view;
    hs_output output;
    hs_surface surface;
    const hs_settings settings = {
        .front_depth = 2, .silhouette_depth = 4, .guard = true, .boundary = HS_BOUNDARY_SMOOTH};
    const hs_style style = {.smooth = true};
    hs_renderer *renderer = hs_renderer_new(200, 160, 3, &err);
    if (!renderer || !hs_mesh_open(&mesh, shape, false, true, &err) ||
        !hs_view_choose(&view, 0, inside(&place, "views.txt"), 1, &mesh, 1.25, &err) ||
        !hs_refine(&output, &mesh, view.matrix, &settings, HS_DEFAULT_LIMITS, &err) ||
        !hs_surface_of_output(&surface, &output, view.matrix, &err) ||
        !hs_renderer_draw(renderer, &surface, &style, picture, &err))
        fail_msg("%s", err.text);
    hs_surface_free(&surface);
    hs_output_free(&output);
    hs_mesh_free(&mesh);
    hs_renderer_free(renderer);
}

/* Silhouettes are compared by what is covered, whatever colours and lights are. */
static void assert_same_silhouette(const char *name, const char *shape, const char *view,
                                   const char *space) {
    char line[1000];
    hs_error err;
    hs_picture ours, theirs;
    hs_picture_difference d;
    FILE *file = fopen(inside(&place, "views.txt"), "w");
    assert_non_null(file);
    fprintf(file, "%s\n", view);
    fclose(file);
    snprintf(line, sizeof line,
             "%s --views @/views.txt -f 2 -s 4 --size 200x160 --space %s -o @/scene.pov", shape,
             space);
    must_convert(line);
    if (shell("povray +W200 +H160 +A0.05 +UA -D Declare=CLEAR=1 +I@/scene.pov +O@/pov.png "
              ">@/pov.log 2>&1") != 0) {
        shell("tail -12 @/pov.log >&2");
        fail_msg("POV-Ray does not like %s", name);
    }
    if (!hs_png_read(&theirs, inside(&place, "pov.png"), &err)) fail_msg("%s", err.text);
    draw_view(&ours, shape);
    assert_true(hs_picture_compare(&d, &ours, &theirs, &err));
    print_message("%s: %llu and %llu pixels covered, %llu by one alone; silhouettes at most %.2f "
                  "pixels apart\n",
                  name, (unsigned long long)d.covered_a, (unsigned long long)d.covered_b,
                  (unsigned long long)d.covered_either, d.maximum);
    assert_true(d.covered_a > 1000 && d.covered_a < 31000);
    assert_true(d.covered_either * 200 < d.covered_a);
    assert_true(d.mean < 0.1 && d.maximum < 3);
    hs_picture_free(&ours);
    hs_picture_free(&theirs);
}

static void pov_ray_sees_what_the_view_sees(void **state) {
    (void)state;
    needs("povray");
    static const char look[] = "look eye 3 4 16 at 1 0 0 up 0.3 1 0 fov 40 near 5 far 40";
    assert_same_silhouette("hand", "shape:hand", look, "object");
    assert_same_silhouette("hand, in device coordinates", "shape:hand", look, "ndc");
    assert_same_silhouette("torus, parallel", "shape:torus",
                           "matrix 0.5 0.1 0 0.1 0 0.3 0.3 -0.2 0 0.2 -0.2 0 0 0 0 1", "object");
    assert_same_silhouette("torus, sheared and mirrored", "shape:torus",
                           "matrix -1.5 0.2 0.3 0.5 0.1 1.2 0.6 -0.3 0.1 0.2 -1.1 1.5 0 0.1 -1 3.5",
                           "object");
    assert_same_silhouette("torus, cut by the nearest plane", "shape:torus",
                           "look eye 0 1 4 at 0 0 0 up 0 1 0 fov 50 near 4 far 9", "object");
}

/* --- The command line ---------------------------------------------------------------------------
 */

static void a_wrong_line_says_what_would_be_right(void **state) {
    (void)state;
    expect(HS_EXIT_USAGE, "shape:cube", "add -o FILE");
    expect(HS_EXIT_USAGE, "shape:cube -o @/cube", "add --to ply");
    expect(HS_EXIT_USAGE, "shape:cube --to glft -o @/x", "did you mean \"gltf\"?");
    expect(HS_EXIT_USAGE, "shape:cube --to stl -o @/x", "ply, gltf, pov or obj");
    expect(HS_EXIT_USAGE, "shape:cube --space world -o @/x.ply", "object, ndc or clip");
    expect(HS_EXIT_USAGE, "shape:cube --space clip -o @/x.pov", "object or ndc");
    expect(HS_EXIT_USAGE, "shape:cube --text -o @/x.glb", "PLY alone");
    expect(HS_EXIT_USAGE, "shape:cube --size 5 -o @/x.glb", "WIDTHxHEIGHT");
    expect(HS_EXIT_USAGE, "shape:cube --orbit 2 --view 2 -o @/x.glb", "views are 0 to 1");
    expect(HS_EXIT_USAGE, "shape:cube --orbit 2 --views @/v -o @/x.glb", "exclude each other");
    expect(HS_EXIT_USAGE, "shape:cuub -o @/x.glb", "did you mean \"cube\"?");
    expect(HS_EXIT_USAGE, "shape:cube --uniform 2 --front 3 -o @/x.glb", "drop it");
    expect(HS_EXIT_FILE, "@/none.obj -o @/x.glb", "none.obj");
    assert_int_equal(count_entries(&place), 0);
}

static void views_without_a_camera_are_refused(void **state) {
    (void)state;
    FILE *file = fopen(inside(&place, "v"), "w");
    assert_non_null(file);
    fputs("matrix 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1\n"   /* flat */
          "matrix 1 0 0 0 0 1 0 0 0 0 1 0 0.1 0 0 1\n" /* eye at infinity */
          "matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 3e38 3e38\n",
          file);
    fclose(file);
    expect(HS_EXIT_VIEWS, "shape:cube --views @/v -o @/x.pov", "singular");
    expect(HS_EXIT_VIEWS, "shape:cube --views @/v --view 1 -o @/x.pov", "at infinity");
    expect(HS_EXIT_REFUSED, "shape:cube --views @/v --view 2 -o @/x.pov", "refused");
    assert_int_equal(count_entries(&place), 1);
    must_convert("shape:cube --views @/v --space ndc -o @/x.pov");
}

static void a_write_that_fails_is_said_and_leaves_nothing(void **state) {
    (void)state;
    static const char *const ending[] = {"ply", "glb", "gltf", "pov", "obj"};
    for (int i = 0; i < 5; i++) {
        char line[200];
        snprintf(line, sizeof line, "shape:cube -o @/none/x.%s", ending[i]);
        expect(HS_EXIT_FILE, line, "none/x.");
        assert_int_equal(count_entries(&place), 0);
    }
    /* The buffer of a document in two files has no place. */
    assert_int_equal(mkdir(inside(&place, "x.bin"), 0700), 0);
    expect(HS_EXIT_FILE, "shape:cube -o @/x.gltf", "x.bin");
    assert_int_equal(count_entries(&place), 1);
    if (access("/dev/full", W_OK) == 0)
        for (int i = 0; i < 5; i++) {
            static const char *const to[] = {"ply", "ply --text", "gltf", "pov", "obj"};
            char line[200];
            snprintf(line, sizeof line, "shape:cube --to %s -o /dev/full", to[i]);
            expect(HS_EXIT_FILE, line, "/dev/full");
        }
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)
    const struct CMUnitTest tests[] = {
        TEST(a_ply_says_the_same_in_text_and_in_binary),
        TEST(an_obj_and_a_ply_have_the_same_polygons),
        TEST(assimp_reads_ply_and_gltf),
        TEST(gltf_files_are_valid),
        TEST(the_validator_sees_what_is_wrong),
        TEST(pov_ray_sees_what_the_view_sees),
        TEST(a_wrong_line_says_what_would_be_right),
        TEST(views_without_a_camera_are_refused),
        TEST(a_write_that_fails_is_said_and_leaves_nothing),
    };
    return cmocka_run_group_tests_name("files for other programs", tests, NULL, NULL);
}
