/* SPDX-License-Identifier: Apache-2.0
 *
 * A program of somebody who has halfstep installed: refines a shape through golden, two steps
 * everywhere, and prints how many faces come out.
 *
 *   cc refine.c -o refine $(pkg-config --cflags --libs halfstep)
 */
#include <stdio.h>

#include <halfstep/golden.h>
#include <halfstep/shape.h>

int main(int argc, char **argv) {
    const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 2, 0, 0, -1, 4};
    const hs_settings settings = {
        .uniform = true, .uniform_depth = 2, .boundary = HS_BOUNDARY_SMOOTH};
    hs_mesh mesh = {0};
    hs_packet in = {0}, out = {0};
    hs_output output = {0};
    hs_golden_report report;
    hs_error err = {0};
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    const bool done = golden && hs_shape_make(&mesh, argc > 1 ? argv[1] : "cube", 0, 1, &err) &&
                      hs_packet_encode(&in, 0, &mesh, matrix, &settings, &err) &&
                      hs_golden_run(golden, &in, &out, &report, &err) &&
                      hs_output_decode(&output, &out, &err);
    if (done)
        printf("%u faces in, %u out, %s\n", mesh.faces, output.faces,
               hs_status_name(output.status));
    else
        fprintf(stderr, "refine: %s\n", err.text);
    hs_output_free(&output);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_mesh_free(&mesh);
    hs_golden_free(golden);
    return done ? 0 : 1;
}
