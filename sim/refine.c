/* SPDX-License-Identifier: Apache-2.0 */
#include "refine.h"

bool hs_refine(hs_output *output, const hs_mesh *mesh, const float matrix[16],
               const hs_settings *settings, hs_limits limits, hs_error *err) {
    *output = (hs_output){0};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_golden *golden = hs_golden_new(limits);
    const bool done = golden ? hs_packet_encode(&in, 0, mesh, matrix, settings, err) &&
                                   hs_golden_run(golden, &in, &out, &report, err) &&
                                   hs_output_decode(output, &out, err) &&
                                   hs_output_accepted(output, err)
                             : hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    hs_golden_free(golden);
    hs_packet_free(&in);
    hs_packet_free(&out);
    if (!done) hs_output_free(output);
    return done;
}
