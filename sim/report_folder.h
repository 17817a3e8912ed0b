/* SPDX-License-Identifier: Apache-2.0
 *
 * What a folder of halfstep run holds, as the data of halfstep report's page:
 *
 *   run        run.json as it is
 *   written    when that file was written: "2026-01-31 12:00 UTC"
 *   pictures   per view, by its number as a string: NAME -> the PNG file as a data URI
 *   meshes     per view likewise: report_mesh.h
 *   timelines  {name, image}: timeline*.svg, as data URIs
 *   with       run.json of other runs, without anything else
 *   explore    explore.json of explorations
 *   notes      sentences: what is missing, and what was left out
 */
#ifndef HS_REPORT_FOLDER_H
#define HS_REPORT_FOLDER_H

#include <jansson.h>

#include "error.h"
#include "options.h"

typedef struct hs_report_request {
    const char *folder;
    const char *json;             /* NULL: run.json in the folder */
    hs_option_list with, explore; /* files, or folders with run.json, explore.json */
    uint32_t faces;               /* of a mesh, at most */
    uint32_t views;               /* with pictures and meshes, at most */
} hs_report_request;

/* Pictures on the page; each is NAME.png in a view's folder. */
extern const char *const hs_report_picture[];

/* Reads all of it. NULL and *err: the folder or a JSON file is missing, broken or no report
 * (HS_EXIT_FILE), memory (HS_EXIT_INTERNAL). Pictures, streams and timelines that are missing or
 * broken are told in notes. */
json_t *hs_report_folder(const hs_report_request *request, hs_error *err);

#endif
