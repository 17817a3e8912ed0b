/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep run in parts: what it was asked for, what it found out, view by view, and the ways in
 * which that is told: the table (run_table.c), the JSON report (report_json.h), the folder.
 *
 *   options -> hs_run -> [ encode -> every engine -> compare ] per view -> hs_run_view
 *                                                                   '-> table, folder, report
 */
#ifndef HS_RUN_H
#define HS_RUN_H

#include <stdio.h>

#include "bound.h"
#include "compare.h"
#include "drop.h"
#include "file.h"
#include "frames.h"
#include "model.h"
#include "path.h"
#include "progress.h"
#include "reference.h"
#include "rtl.h"
#include "run_pictures.h"
#include "timeline.h"
#include "view.h"

/* The engines of this program, in the order in which they run. */
enum hs_engine {
    HS_ENGINE_reference,
    HS_ENGINE_golden,
    HS_ENGINE_model,
    HS_ENGINE_rtl,
    HS_ENGINES
};
const char *hs_engine_name(enum hs_engine engine);
/* True for model and rtl. */
bool hs_engine_timed(enum hs_engine engine);

/* Reads a list as in "golden,rtl" into a set of bits 1 << engine (HS_EXIT_USAGE). */
bool hs_engines_parse(const char *list, uint32_t *engines, hs_error *err);

/* What a run was asked for. Text belongs to the command line. */
typedef struct hs_run_request {
    const char *mesh, *views, *force, *out, *json, *wave; /* NULL: not given */
    bool path; /* views are the consecutive frames of a path */
    const char *timeline, *kanata, *timeline_svg;
    char own_json[4200];       /* where json points if out alone is */
    uint32_t orbit;            /* viewpoints, if there is no file */
    uint32_t only;             /* the one view to run, or UINT32_MAX */
    uint32_t width, height;    /* pixels */
    uint32_t engines;          /* bits 1 << engine */
    uint32_t reference_levels; /* of the pictures' reference surface */
    hs_settings settings;
    hs_drop drop; /* from mesh.obj */
    hs_limits limits;
    hs_stalls stalls;
    uint32_t wave_first, wave_last; /* cycles of the view */
    bool round_sharpness, quiet;
} hs_run_request;

/* What one engine made of one view. */
typedef struct hs_engine_result {
    bool ran;
    uint32_t status, error_position;
    uint32_t vertices, faces,
        triangles;     /* sent; of the reference: final faces and their vertices */
    uint32_t at_level; /* with settings.limit: vertices sent where their level has them */
    double seconds;
    uint64_t words;  /* of the output packet; 0 for the reference */
    uint32_t digest; /* of all its words but the last, CRC-32: hs_packet_crc */
} hs_engine_result;

/* Two engines compared. It holds if something was compared, and nothing was different. */
typedef struct hs_comparison {
    enum hs_engine a, b;
    const char *what; /* "words", "transactions", "counters", "faces", "positions", "pixels" */
    uint64_t compared, different;
} hs_comparison;

enum { HS_RUN_COMPARISONS = 16 };

/* Cycles from the first beat in to the beat out that holds the first face, and the trailer;
 * HS_NO_CYCLE where there is none. */
typedef struct hs_latency {
    uint64_t first_face, trailer;
} hs_latency;

/* Everything known of one view. */
typedef struct hs_run_view {
    uint32_t number;                                    /* from 0; TID of its packets */
    uint32_t mesh_vertices, mesh_faces, mesh_halfedges; /* of what went in */
    hs_engine_result engine[HS_ENGINES];
    uint32_t generations;
    hs_generation *generation; /* golden's; owned */
    int32_t exponent;
    size_t words_in;
    hs_bound bound;
    hs_cycle_report cycles[HS_ENGINES]; /* of those that have a clock: hs_engine_timed */
    hs_latency latency[HS_ENGINES];
    uint64_t *generation_cycle;        /* model's, if it ran: hs_model_generation_cycle; owned */
    hs_reference_decisions decisions;  /* if reference ran */
    hs_reference_comparison reference; /* if reference and golden were compared */
    uint32_t comparisons;
    hs_comparison comparison[HS_RUN_COMPARISONS];
    hs_path_step step;                /* beside the frame before, on a path */
    hs_dropped dropped;               /* from mesh.obj */
    hs_run_pictures_report *pictures; /* owned; NULL if there are none */
} hs_run_view;

/* The timelines in work (run_timeline.h). */
typedef struct hs_run_timelines {
    hs_file json_file, kanata_file, svg_file;
    hs_timeline_json json;
    hs_timeline_kanata kanata;
} hs_run_timelines;

typedef struct hs_run {
    const hs_run_request *request;
    hs_frames frames; /* of a deforming mesh */
    hs_mesh mesh;     /* of a deforming one: the view's */
    hs_views views;
    uint32_t depth; /* that the views ask for */
    hs_path *path;  /* NULL unless asked for */
    hs_golden *golden;
    hs_model *model; /* NULL unless named, as the next ones */
    hs_rtl *rtl;
    hs_log model_log, rtl_log; /* in use if both are, or if a timeline is wanted */
    hs_run_timelines timelines;
    hs_run_pictures *pictures; /* NULL unless there is a folder */
    int folder_lock;           /* on the folder; -1: none */
    hs_progress progress;
    FILE *table;       /* what people read: standard output, unless the report goes there */
    uint32_t done;     /* views */
    hs_run_view *view; /* done of them */
    double seconds;
} hs_run;

/* Runs one view through the engines and compares. Comparisons that fail are no failure here: they
 * are in *view, and said on stderr with the command that reruns this view. False: an engine broke
 * down, memory, files. *view is owned by the caller either way. */
bool hs_run_one(hs_run *run, uint32_t number, hs_run_view *view, hs_error *err);
void hs_run_view_free(hs_run_view *view);
/* Whether all comparisons of the view hold. */
bool hs_run_view_equal(const hs_run_view *view);

/* Says on stderr what differs in a view and prints the command that runs it alone, with a waveform
 * of the cycles around the difference. cycle: from the view's start; HS_NO_CYCLE: unknown. */
void hs_run_print_rerun(const hs_run *run, uint32_t number, uint64_t cycle);

/* The table on run->table: a head, a line a view, totals. */
void hs_run_table_head(const hs_run *run);
void hs_run_table_view(const hs_run *run, const hs_run_view *view);
void hs_run_table_total(const hs_run *run);

/* Behind it, what changed from frame to frame of a path (run_path.c). */
void hs_run_table_path(const hs_run *run);

#endif
