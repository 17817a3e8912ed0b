/* SPDX-License-Identifier: Apache-2.0 */
#include "report_folder.h"

#include <glob.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "file.h"
#include "json_file.h"
#include "report_mesh.h"
#include "report_pack.h"

const char *const hs_report_picture[] = {"initial",    "refined", "side",       "refined-wires",
                                         "side-wires", "facing",  "difference", NULL};

enum {
    MOST_JSON = 256 << 20,
    MOST_PICTURE = 16 << 20,
    MOST_TIMELINE = 8 << 20,
    MOST_TIMELINES = 4
};

/* --- JSON that may run out of memory ------------------------------------------------------------
 */

typedef struct work {
    const hs_report_request *request;
    json_t *notes, *pictures, *meshes;
    bool complete; /* memory was there for all that was made */
} work;

static void set(work *w, json_t *object, const char *key, json_t *value) {
    hs_json_set(object, key, value, &w->complete);
}

static void append(work *w, json_t *array, json_t *value) {
    hs_json_append(array, value, &w->complete);
}

__attribute__((format(printf, 2, 3))) static void note(work *w, const char *format, ...) {
    char text[1000];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    json_t *string = json_string(text);
    append(w, w->notes, string ? string : json_string("(a name that is not UTF-8)"));
}

static bool join(char path[PATH_MAX], const char *folder, const char *name, hs_error *err) {
    const int length = snprintf(path, PATH_MAX, "%s/%s", folder, name);
    if (length > 0 && length < PATH_MAX) return true;
    return hs_fail(err, HS_EXIT_FILE, "%.300s...: the name of this folder is too long", folder);
}

static bool is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* --- Reports ------------------------------------------------------------------------------------
 */

/* A JSON file: an object with an array `list` in it. path may be a folder that holds `name`. */
static json_t *read_json(const char *path, const char *name, const char *list, const char *made_by,
                         hs_error *err) {
    char inside[PATH_MAX];
    if (is_folder(path)) {
        if (!join(inside, path, name, err)) return NULL;
        path = inside;
    }
    uint8_t *bytes;
    size_t size;
    if (!hs_file_read(path, MOST_JSON, &bytes, &size, err)) {
        if (err->code != HS_EXIT_FILE) return NULL;
        const size_t used = strlen(err->text);
        snprintf(err->text + used, sizeof err->text - used, "; %s writes it", made_by);
        return NULL;
    }
    json_error_t why;
    json_t *root = json_loadb((const char *)bytes, size, JSON_REJECT_DUPLICATES, &why);
    free(bytes);
    if (!root) {
        hs_fail(err, HS_EXIT_FILE, "%.300s:%d: is no JSON: %.100s; %s writes it", path, why.line,
                why.text, made_by);
        return NULL;
    }
    if (json_is_array(json_object_get(root, list))) return root;
    hs_fail(err, HS_EXIT_FILE, "%.300s: has no \"%s\", so it is no report of %s", path, list,
            made_by);
    json_decref(root);
    return NULL;
}

static const char BY_RUN[] = "`halfstep run MESH --out DIR`";
static const char BY_EXPLORE[] = "`halfstep explore MESH --out DIR`";

/* What the page reads of a view; the rest may be missing. */
static bool check_views(const json_t *run, const char *path, hs_error *err) {
    const json_t *views = json_object_get(run, "views");
    for (size_t i = 0; i < json_array_size(views); i++) {
        const json_t *view = json_array_get(views, i);
        const json_t *number = json_object_get(view, "view");
        if (json_is_integer(number) && json_integer_value(number) >= 0 &&
            json_integer_value(number) <= UINT16_MAX &&
            json_is_object(json_object_get(view, "engines")))
            continue;
        return hs_fail(err, HS_EXIT_FILE,
                       "%.300s: views[%zu] has no number or no engines, so it is no report of %s",
                       path, i, BY_RUN);
    }
    return true;
}

static json_t *read_run(const char *path, hs_error *err) {
    json_t *run = read_json(path, "run.json", "views", BY_RUN, err);
    if (run && check_views(run, path, err)) return run;
    json_decref(run);
    return NULL;
}

static json_t *read_list(work *w, const hs_option_list *list,
                         json_t *(*read)(const char *, hs_error *), hs_error *err) {
    json_t *all = json_array();
    for (uint32_t i = 0; i < list->count; i++) {
        json_t *one = read(list->text[i], err);
        if (!one) {
            json_decref(all);
            return NULL;
        }
        append(w, all, one);
    }
    return all;
}

static json_t *read_exploration(const char *path, hs_error *err) {
    return read_json(path, "explore.json", "points", BY_EXPLORE, err);
}

static json_t *time_of(const char *path) {
    struct stat status;
    struct tm utc;
    char text[40] = "";
    if (stat(path, &status) == 0 && gmtime_r(&status.st_mtime, &utc))
        strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
    return json_string(text);
}

/* --- Pictures -----------------------------------------------------------------------------------
 */

/* A file as a data URI; NULL and a note if it cannot be. */
static json_t *read_image(work *w, const char *path, const char *prefix, size_t most,
                          const char *begins, size_t length) {
    hs_error why = {0};
    uint8_t *bytes;
    size_t size;
    if (!hs_file_read(path, most, &bytes, &size, &why)) {
        note(w, "%s", why.text);
        return NULL;
    }
    json_t *image = NULL;
    if (size >= length && memcmp(bytes, begins, length) == 0) {
        image = hs_base64_json(prefix, bytes, size);
        if (!image) w->complete = false;
    } else {
        note(w, "%.300s: is no picture that a browser would show", path);
    }
    free(bytes);
    return image;
}

static json_t *read_pictures(work *w, const char *folder, hs_error *err) {
    json_t *pictures = json_object();
    char path[PATH_MAX], name[64];
    for (int i = 0; hs_report_picture[i]; i++) {
        snprintf(name, sizeof name, "%s.png", hs_report_picture[i]);
        if (!join(path, folder, name, err)) break;
        json_t *image =
            read_image(w, path, "data:image/png;base64,", MOST_PICTURE, "\x89PNG\r\n\x1a\n", 8);
        if (image) set(w, pictures, hs_report_picture[i], image);
    }
    return pictures;
}

/* An image element runs no scripts, whatever the SVG holds. */
static json_t *read_timelines(work *w, hs_error *err) {
    json_t *timelines = json_array();
    char pattern[PATH_MAX];
    glob_t found = {0};
    if (join(pattern, w->request->folder, "timeline*.svg", err) &&
        glob(pattern, 0, NULL, &found) == 0) {
        for (size_t i = 0; i < found.gl_pathc && i < MOST_TIMELINES; i++) {
            const char *path = found.gl_pathv[i], *name = strrchr(path, '/');
            json_t *image =
                read_image(w, path, "data:image/svg+xml;base64,", MOST_TIMELINE, "<", 1);
            if (image)
                append(w, timelines,
                       json_pack("{s:s, s:o}", "name", name ? name + 1 : path, "image", image));
        }
        if (found.gl_pathc > MOST_TIMELINES)
            note(w, "of %zu timelines the first %d are shown", found.gl_pathc, MOST_TIMELINES);
    }
    globfree(&found);
    return timelines;
}

/* --- Views --------------------------------------------------------------------------------------
 */

static bool read_view(work *w, hs_golden *golden, uint32_t number, hs_error *err) {
    char folder[PATH_MAX], name[32], key[16], why[500];
    snprintf(name, sizeof name, "view-%03u", number);
    snprintf(key, sizeof key, "%u", number);
    if (!join(folder, w->request->folder, name, err)) return false;
    if (!is_folder(folder)) {
        note(w, "view %u: there is no folder %.300s, so it has no pictures and no mesh", number,
             folder);
        return true;
    }
    set(w, w->pictures, key, read_pictures(w, folder, err));
    const hs_report_mesh_request request = {folder, w->request->faces, golden};
    json_t *mesh = hs_report_mesh(&request, why, sizeof why, err);
    if (mesh)
        set(w, w->meshes, key, mesh);
    else if (why[0])
        note(w, "view %u: no mesh is shown: %s", number, why);
    else
        return false;
    return true;
}

/* All views, or as many as were asked for, evenly spaced. */
static bool read_views(work *w, const json_t *run, hs_error *err) {
    const json_t *views = json_object_get(run, "views");
    const size_t count = json_array_size(views), most = w->request->views,
                 shown = count < most ? count : most;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    if (!golden) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    bool good = true;
    for (size_t i = 0; good && i < shown; i++) {
        const json_t *view = json_array_get(views, i * count / shown);
        const json_t *number = json_object_get(view, "view");
        good = read_view(w, golden, (uint32_t)json_integer_value(number), err);
    }
    hs_golden_free(golden);
    if (shown < count)
        note(w, "pictures and meshes are those of %zu of %zu views, evenly spaced (--views)", shown,
             count);
    return good;
}

/* --- All of it ----------------------------------------------------------------------------------
 */

/* False if something failed; *data may be incomplete then. */
static bool read_all(work *w, json_t *data, hs_error *err) {
    const hs_report_request *r = w->request;
    char path[PATH_MAX];
    if (!is_folder(r->folder))
        return hs_fail(err, HS_EXIT_FILE, "%.300s: there is no such folder; %s makes one",
                       r->folder, BY_RUN);
    if (!join(path, r->folder, "run.json", err)) return false;
    const char *json = r->json ? r->json : path;
    json_t *run = read_run(json, err);
    if (!run) return false;
    set(w, data, "run", run);
    set(w, data, "written", time_of(json));
    json_t *with = read_list(w, &r->with, read_run, err);
    if (!with) return false;
    set(w, data, "with", with);
    json_t *explore = read_list(w, &r->explore, read_exploration, err);
    if (!explore) return false;
    set(w, data, "explore", explore);
    set(w, data, "timelines", read_timelines(w, err));
    return read_views(w, run, err);
}

json_t *hs_report_folder(const hs_report_request *request, hs_error *err) {
    work w = {.request = request,
              .notes = json_array(),
              .pictures = json_object(),
              .meshes = json_object(),
              .complete = true};
    json_t *data = json_object();
    bool good = read_all(&w, data, err);
    set(&w, data, "notes", w.notes);
    set(&w, data, "pictures", w.pictures);
    set(&w, data, "meshes", w.meshes);
    if (good && !w.complete)
        good = hs_fail(err, HS_EXIT_INTERNAL, "%.300s: no memory for its report", request->folder);
    if (good) return data;
    json_decref(data);
    return NULL;
}
