/* SPDX-License-Identifier: Apache-2.0
 *
 * The table of a camera path: what changes from frame to frame.
 */
#include "run.h"

void hs_run_table_path(const hs_run *run) {
    uint64_t compared = 0, moved = 0;
    fprintf(run->table, "\nframe    faces   gained     lost vertices   shared compared  moved "
                        "silhouette\n");
    for (uint32_t i = 0; i < run->done; i++) {
        const hs_run_view *view = &run->view[i];
        const hs_path_step *step = &view->step;
        if (!step->done) {
            fprintf(run->table, "%5u %8s\n", view->number, "refused");
            continue;
        }
        fprintf(run->table, "%5u %8u", view->number, step->faces);
        if (step->first)
            fprintf(run->table, " %8s %8s %8u %8s %8s %6s", "-", "-", step->vertices, "-", "-",
                    "-");
        else
            fprintf(run->table, " %8u %8u %8u %8u %8u %6u", step->gained, step->lost,
                    step->vertices, step->shared, step->compared, step->moved);
        const double all = step->reached + step->short_of;
        if (all > 0)
            fprintf(run->table, " %8.2f %%\n", 100 * step->reached / all);
        else
            fprintf(run->table, " %10s\n", "-");
        compared += step->compared;
        moved += step->moved;
    }
    fprintf(run->table, "of %llu vertices that two frames have at one level, %llu moved\n",
            (unsigned long long)compared, (unsigned long long)moved);
}
