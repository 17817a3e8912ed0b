/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep run: a mesh and viewpoints through the engines.
 */
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "file.h"
#include "options.h"
#include "report_json.h"
#include "run.h"
#include "run_mesh.h"
#include "run_timeline.h"
#include "surface_options.h"

static const hs_command COMMAND = {
    .name = "run",
    .operands = "MESH",
    .least = 1,
    .most = 1,
    .what = "Streams a mesh, viewpoint by viewpoint, through the engines and compares them",
    .text = "MESH is an OBJ file, shape:NAME[:SIZE[:SEED]] (`halfstep mesh list`), or a pattern\n"
            "with %d for a mesh that deforms.\n"
            "\n"
            "Engines: reference  doubles, the paper to the letter; replays golden's decisions\n"
            "         golden     integers in C: what every output word has to be\n"
            "         model      in C as well: when the rtl sends it, to the cycle\n"
            "         rtl        the SystemVerilog, under Verilator, cycle by cycle\n"
            "\n"
            "Examples:\n"
            "  halfstep run shape:cube\n"
            "      one view of a cube, every word of rtl compared with golden\n"
            "  halfstep run shape:hand --orbit 8 --out out/hand --json out/hand.json\n"
            "      eight viewpoints; meshes and pictures in out/hand, figures in the JSON\n"
            "  halfstep run bob.obj --uniform 6 --engine golden,reference\n"
            "      three Catmull-Clark levels everywhere, integers against doubles\n"
            "  halfstep run shape:grid --min-edge-px 4 --limit --size 1024x1024\n"
            "      until edges are shorter than 4 pixels, vertices on the limit surface\n"
            "  halfstep run bob.obj --views my.txt --stalls 30,50 --seed 7\n"
            "      your own viewpoints (docs/command-line.md), both sides of the streams\n"
            "      pausing at random in 30 and 50 % of the cycles\n"
            "  halfstep run shape:hand --path path.txt --engine golden\n"
            "      a camera path, and what changes from frame to frame\n"
            "  halfstep run 'frame_%04d.obj' --out out/frames\n"
            "      a mesh a view: frame_0000.obj, frame_0001.obj and so on\n"
            "  halfstep run shape:hand --engine model --timeline hand.json --kanata hand.log\n"
            "      what was at work when: for Perfetto, and for Konata (docs/timeline.md)\n"
            "\n"
            "Exits 0 if all comparisons hold, 1 if engines differ, 7 if a view was refused;\n"
            "docs/command-line.md has all codes, and the keys of the JSON report.\n"};

/* --- The request --------------------------------------------------------------------------------
 */

static const char *const ENGINE_NAME[HS_ENGINES] = {"reference", "golden", "model", "rtl"};

const char *hs_engine_name(enum hs_engine engine) {
    return ENGINE_NAME[engine];
}

bool hs_engine_timed(enum hs_engine engine) {
    return engine == HS_ENGINE_model || engine == HS_ENGINE_rtl;
}

bool hs_engines_parse(const char *list, uint32_t *engines, hs_error *err) {
    const char *names[HS_ENGINES + 1] = {NULL};
    memcpy(names, ENGINE_NAME, sizeof ENGINE_NAME);
    char text[100], *rest = text, *name;
    if (strlen(list) >= sizeof text)
        return hs_fail(err, HS_EXIT_USAGE, "--engine: \"%.60s...\" is too long", list);
    memcpy(text, list, strlen(list) + 1);
    *engines = 0;
    while ((name = strsep(&rest, ",")) != NULL) {
        int e = 0;
        while (e < HS_ENGINES && strcmp(name, ENGINE_NAME[e]) != 0)
            e++;
        if (e == HS_ENGINES) {
            const char *nearest = hs_nearest(name, names);
            return hs_fail(
                err, HS_EXIT_USAGE,
                "--engine: no engine \"%s\"%s%s%s; there are reference, golden, model and "
                "rtl",
                name, nearest ? "; did you mean \"" : "", nearest ? nearest : "",
                nearest ? "\"?" : "");
        }
        *engines |= 1u << e;
    }
    return true;
}

/* Texts that need more than a range check. */
typedef struct texts {
    const char *engines, *size, *stalls, *window, *drop;
    hs_surface_options surface;
    const char *path;
    bool orbit_given, seed_given, only_given;
} texts;

/* How many files go to standard output. */
static int to_stdout(const hs_run_request *r) {
    const char *const path[] = {r->json, r->timeline, r->kanata, r->timeline_svg};
    int count = 0;
    for (size_t i = 0; i < sizeof path / sizeof *path; i++)
        count += path[i] && strcmp(path[i], "-") == 0;
    return count;
}

static bool complete(hs_run_request *r, const texts *t, hs_error *err) {
    if (!hs_engines_parse(t->engines, &r->engines, err)) return false;
    if (!hs_size_parse(t->size, &r->width, &r->height, err)) return false;
    if (t->stalls) {
        uint32_t in, out;
        if (!hs_pair_parse(t->stalls, ',', &in, &out) || in > 95 || out > 95)
            return hs_fail(err, HS_EXIT_USAGE,
                           "--stalls is \"%.40s\"; it should be IN,OUT, each 0 to 95 per cent of "
                           "the cycles, as in 30,50",
                           t->stalls);
        r->stalls.input = (uint8_t)in;
        r->stalls.output = (uint8_t)out;
    }
    r->wave_last = UINT32_MAX;
    if (t->window && (!hs_pair_parse(t->window, ':', &r->wave_first, &r->wave_last) ||
                      r->wave_first > r->wave_last))
        return hs_fail(err, HS_EXIT_USAGE,
                       "--wave-cycles is \"%.40s\"; it should be FIRST:LAST, cycles of the view, "
                       "as in 100:2000",
                       t->window);
    if (t->window && !r->wave)
        return hs_fail(err, HS_EXIT_USAGE, "--wave-cycles needs --wave FILE");
    if (r->wave && !(r->engines >> HS_ENGINE_rtl & 1))
        return hs_fail(err, HS_EXIT_USAGE, "--wave shows the rtl; add rtl to --engine");
    if (hs_run_timelines_wanted(r) && !(r->engines & (1u << HS_ENGINE_rtl | 1u << HS_ENGINE_model)))
        return hs_fail(err, HS_EXIT_USAGE,
                       "--timeline, --kanata and --timeline-svg need cycles; add model or rtl to "
                       "--engine");
    if (to_stdout(r) > 1)
        return hs_fail(err, HS_EXIT_USAGE,
                       "only one of --json, --timeline, --kanata and --timeline-svg can go to "
                       "standard output; give the others a file");
    if (t->drop && !r->out)
        return hs_fail(err, HS_EXIT_USAGE, "--drop leaves faces out of mesh.obj; add --out DIR");
    if (!hs_drop_parse(t->drop, &r->drop, err)) return false;
    if (t->path && (r->views || t->orbit_given))
        return hs_fail(err, HS_EXIT_USAGE, "--path names its views; drop --views and --orbit");
    if (t->path && !(r->engines >> HS_ENGINE_golden & 1))
        return hs_fail(err, HS_EXIT_USAGE, "--path follows golden; add golden to --engine");
    if (t->path) {
        r->path = true;
        r->views = t->path;
    }
    if (r->views && t->orbit_given)
        return hs_fail(err, HS_EXIT_USAGE, "--views and --orbit exclude each other; give one");
    return hs_surface_settings(&r->settings, &t->surface, r->force != NULL, r->width, r->height,
                               err);
}

static enum hs_parsed parse(hs_run_request *r, int argc, char **argv, hs_error *err) {
    const uint32_t most = 1u << HS_INDEX_BITS;
    *r = (hs_run_request){.orbit = 1,
                          .only = UINT32_MAX,
                          .reference_levels = 4,
                          .limits = HS_DEFAULT_LIMITS,
                          .stalls = {.seed = 1}};
    texts t = {.engines = "golden,model,rtl", .size = "768x768", .surface = HS_SURFACE_DEFAULTS};
    const hs_option option[] = {
        {"orbit", 'n', HS_OPTION_NUMBER, "N", &r->orbit, 1, 65536, &t.orbit_given,
         "N viewpoints on a circle around the mesh (1)"},
        {"views", 'v', HS_OPTION_TEXT, "FILE", &r->views, 0, 0, NULL,
         "viewpoints from a file: `matrix` or `look` lines"},
        {"path", 'p', HS_OPTION_TEXT, "FILE", &t.path, 0, 0, NULL,
         "the same, as consecutive frames: tells what changes"},
        {"view", 0, HS_OPTION_NUMBER, "N", &r->only, 0, 65535, &t.only_given,
         "only view N of them, from 0"},
        {"front", 'f', HS_OPTION_NUMBER, "DEPTH", &t.surface.front, 0, HS_MAX_DEPTH,
         &t.surface.front_given, "steps for front faces in view (4)"},
        {"silhouette", 's', HS_OPTION_NUMBER, "DEPTH", &t.surface.silhouette, 0, HS_MAX_DEPTH,
         &t.surface.silhouette_given, "steps for faces at the silhouette (8)"},
        {"guard", 'g', HS_OPTION_NUMBER, "0|1", &t.surface.guard, 0, 1, NULL,
         "refine the ring around selected faces as well (1)"},
        {"uniform", 'u', HS_OPTION_NUMBER, "DEPTH", &t.surface.uniform, 0, HS_MAX_DEPTH,
         &t.surface.uniform_given, "so many steps everywhere, whatever the view shows"},
        {"min-edge-px", 0, HS_OPTION_TEXT, "PIXELS", &t.surface.min_edge, 0, 0, NULL,
         "leave faces alone whose edges are all shorter; depths\nthat are not given then are 24"},
        {"boundary", 'b', HS_OPTION_TEXT, "MODE", &t.surface.boundary, 0, 0, NULL,
         "kept, smooth or edge-only (smooth)"},
        {"limit", 'l', HS_OPTION_FLAG, NULL, &t.surface.limit, 0, 0, NULL,
         "send vertices at their limit positions"},
        {"round-sharpness", 0, HS_OPTION_FLAG, NULL, &r->round_sharpness, 0, 0, NULL,
         "round fractions of a sharpness, halves up"},
        {"force", 0, HS_OPTION_TEXT, "FILE", &r->force, 0, 0, NULL,
         "depths for single faces: lines `FIRST-LAST DEPTH`,\nfaces from 1 as in the mesh"},
        {"engine", 'e', HS_OPTION_TEXT, "LIST", &t.engines, 0, 0, NULL,
         "reference, golden, model, rtl (golden,model,rtl)"},
        {"out", 'o', HS_OPTION_TEXT, "DIR", &r->out, 0, 0, NULL,
         "folder for views, meshes, pictures and run.json"},
        HS_DROP_OPTION(t.drop, "mesh.obj"),
        {"json", 'j', HS_OPTION_TEXT, "FILE", &r->json, 0, 0, NULL,
         "report with all figures (DIR/run.json)"},
        {"size", 0, HS_OPTION_TEXT, "WxH", &t.size, 0, 0, NULL,
         "pixels of a picture, and the views' aspect (768x768)"},
        {"levels", 0, HS_OPTION_NUMBER, "N", &r->reference_levels, 0, 8, NULL,
         "Catmull-Clark levels of the reference surface that\npictures are compared with (4)"},
        {"stalls", 0, HS_OPTION_TEXT, "IN,OUT", &t.stalls, 0, 0, NULL,
         "per cent of the cycles in which the streams pause"},
        {"seed", 0, HS_OPTION_NUMBER, "N", &r->stalls.seed, 0, UINT32_MAX, NULL,
         "of the stalls, and of rtl's initial memories (1)"},
        {"max-vertices", 0, HS_OPTION_NUMBER, "N", &r->limits.vertices, 1, most, NULL,
         "run-time limit of vertices (524288)"},
        {"max-quads", 0, HS_OPTION_NUMBER, "N", &r->limits.quads, 1, most, NULL,
         "run-time limit of active quads (524288)"},
        {"wave", 0, HS_OPTION_TEXT, "FILE", &r->wave, 0, 0, NULL,
         "waveform (FST) of rtl; for one view"},
        {"wave-cycles", 0, HS_OPTION_TEXT, "A:B", &t.window, 0, 0, NULL,
         "only these cycles, counted from the view's start"},
        {"timeline", 0, HS_OPTION_TEXT, "FILE", &r->timeline, 0, 0, NULL,
         "what was at work when, as a trace for Perfetto"},
        {"kanata", 0, HS_OPTION_TEXT, "FILE", &r->kanata, 0, 0, NULL,
         "each quad's way through the stages, for Konata"},
        {"timeline-svg", 0, HS_OPTION_TEXT, "FILE", &r->timeline_svg, 0, 0, NULL,
         "the timeline as a picture; for one view"},
        {"quiet", 'q', HS_OPTION_FLAG, NULL, &r->quiet, 0, 0, NULL, "no notes, no progress line"},
        {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&COMMAND, option, argc, argv, &operand, err);
    if (parsed != HS_PARSED) return parsed;
    r->mesh = argv[operand];
    if (r->out && !r->json) {
        snprintf(r->own_json, sizeof r->own_json, "%s/run.json", r->out);
        r->json = r->own_json;
    }
    return complete(r, &t, err) ? HS_PARSED : HS_PARSED_WRONG;
}

/* --- Before the long work -----------------------------------------------------------------------
 */

/* Finds out now whether a file could be written later; whole: only in place of a regular one. */
static bool try_file(const char *path, bool whole, hs_error *err) {
    hs_file file;
    if (!hs_file_create(&file, path, err)) return false;
    const bool good =
        !whole || hs_file_temporary(&file) ||
        hs_fail(err, HS_EXIT_FILE, "%.300s: is no regular file; choose another", path);
    hs_file_abandon(&file);
    return good;
}

static bool check_views(const hs_run *run, hs_error *err) {
    const hs_run_request *r = run->request;
    if (r->only != UINT32_MAX && r->only >= run->views.count)
        return hs_fail(err, HS_EXIT_USAGE, "--view %u: there are views 0 to %u", r->only,
                       run->views.count - 1);
    if (r->wave && r->only == UINT32_MAX && run->views.count > 1)
        return hs_fail(err, HS_EXIT_USAGE, "--wave records one view; choose it with --view N");
    if (r->timeline_svg && r->only == UINT32_MAX && run->views.count > 1)
        return hs_fail(err, HS_EXIT_USAGE,
                       "--timeline-svg draws one view; choose it with --view N");
    return true;
}

static bool prepare(hs_run *run, hs_error *err) {
    const hs_run_request *r = run->request;
    if (!hs_run_mesh_open(run, err) || !check_views(run, err)) return false;
    if (r->out) {
        char path[4096];
        if (!hs_folder_make(r->out, err) || !hs_folder_lock(r->out, &run->folder_lock, err))
            return false;
        snprintf(path, sizeof path, "%s/views.txt", r->out);
        if (!hs_views_write(&run->views, path, err)) return false;
        if (r->engines & ~(1u << HS_ENGINE_reference)) {
            run->pictures = hs_run_pictures_new(&run->mesh, &r->settings, r->width, r->height,
                                                r->reference_levels, err);
            if (!run->pictures) return false;
        }
    }
    if (r->json && !try_file(r->json, false, err)) return false;
    if (r->wave && !try_file(r->wave, true, err)) return false;
    if (r->path && run->frames.count)
        return hs_fail(err, HS_EXIT_USAGE,
                       "--path compares frames of one mesh; give a deforming one's by --views");
    if (r->path && !(run->path = hs_path_new(&run->mesh)))
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the path");
    run->golden = hs_golden_new(r->limits);
    if (!run->golden) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    if (r->engines >> HS_ENGINE_model & 1) {
        run->model = hs_model_new(r->limits, HS_DEFAULT_CONFIG, err);
        if (!run->model) return false;
    }
    if (r->engines >> HS_ENGINE_rtl & 1) {
        hs_progress_show(&run->progress, "building the simulation of the rtl");
        run->rtl = hs_rtl_new(r->limits, r->stalls.seed, err);
        if (!run->rtl) return false;
    }
    if (!hs_run_timelines_begin(run, err)) return false;
    const uint32_t count = r->only == UINT32_MAX ? run->views.count : 1;
    run->view = calloc(count, sizeof *run->view);
    return run->view || hs_fail(err, HS_EXIT_INTERNAL, "no memory for the reports");
}

/* --- The run ------------------------------------------------------------------------------------
 */

/* Stops behind the first view in which engines differ. */
static bool run_views(hs_run *run, hs_error *err) {
    const uint32_t only = run->request->only;
    const uint32_t first = only == UINT32_MAX ? 0 : only;
    const uint32_t end = only == UINT32_MAX ? run->views.count : only + 1;
    const double start = hs_seconds();
    hs_progress_clear(&run->progress);
    hs_progress_start(&run->progress, run->request->quiet);
    hs_run_table_head(run);
    bool equal = true;
    for (uint32_t number = first; number < end && equal; number++) {
        hs_progress_count(&run->progress, number - first, number - first, end - first, "views");
        hs_run_view *view = &run->view[run->done];
        const bool good = hs_run_mesh_enter(run, number, err) && hs_run_one(run, number, view, err);
        hs_progress_clear(&run->progress);
        if (!good) {
            hs_run_view_free(view);
            return false;
        }
        run->done++;
        hs_run_table_view(run, view);
        equal = hs_run_view_equal(view);
    }
    run->seconds = hs_seconds() - start;
    hs_run_table_total(run);
    if (run->path) hs_run_table_path(run);
    return true;
}

static int exit_code(const hs_run *run) {
    int code = HS_EXIT_OK;
    for (uint32_t i = 0; i < run->done; i++) {
        if (!hs_run_view_equal(&run->view[i])) return HS_EXIT_DIFFERENT;
        for (int e = 0; e < HS_ENGINES; e++)
            if (run->view[i].engine[e].status > HS_STATUS_STOPPED) code = HS_EXIT_REFUSED;
    }
    return code;
}

static bool run_all(hs_run *run, hs_error *err) {
    if (!prepare(run, err) || !run_views(run, err)) return false;
    const hs_run_request *r = run->request;
    if (!hs_run_timelines_end(run, err)) return false;
    if (r->json && !hs_report_write(run, err)) return false;
    if (r->out) fprintf(run->table, "folder: %s\n", r->out);
    if (r->json && strcmp(r->json, "-") != 0) fprintf(run->table, "report: %s\n", r->json);
    if (r->wave) fprintf(run->table, "waveform: %s\n", r->wave);
    const char *const timeline[] = {r->timeline, r->kanata, r->timeline_svg};
    for (int i = 0; i < 3; i++)
        if (timeline[i] && strcmp(timeline[i], "-") != 0)
            fprintf(run->table, "timeline: %s\n", timeline[i]);
    return true;
}

int hs_command_run(int argc, char **argv, hs_error *err) {
    hs_run_request request;
    const enum hs_parsed parsed = parse(&request, argc, argv, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;

    hs_run run = {
        .request = &request, .table = to_stdout(&request) ? stderr : stdout, .folder_lock = -1};
    hs_progress_start(&run.progress, request.quiet);
    const bool good = run_all(&run, err);
    hs_progress_clear(&run.progress);
    const int code = good ? exit_code(&run) : err->code;
    for (uint32_t i = 0; i < run.done; i++)
        hs_run_view_free(&run.view[i]);
    free(run.view);
    hs_run_timelines_abandon(&run);
    hs_run_pictures_free(run.pictures);
    hs_path_free(run.path);
    hs_rtl_free(run.rtl);
    hs_model_free(run.model);
    hs_log_free(&run.model_log);
    hs_log_free(&run.rtl_log);
    hs_golden_free(run.golden);
    hs_views_free(&run.views);
    hs_mesh_free(&run.mesh);
    hs_folder_unlock(&run.folder_lock);
    return code;
}
