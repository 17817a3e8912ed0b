/* SPDX-License-Identifier: Apache-2.0
 *
 * The files that tell a timeline: each is well-formed by a reader that knows its format and not its
 * writer, and a log that makes no sense does no harm.
 */
#include "random.h"
#include "timeline_samples.h"

#include <ctype.h>
#include <jansson.h>

/* --- JSON ---------------------------------------------------------------------------------------
 */

static char *text;
static size_t text_size;

static FILE *begin_text(void) {
    free(text);
    text = NULL;
    FILE *file = open_memstream(&text, &text_size);
    assert_non_null(file);
    return file;
}

static void write_json(const taken *v, uint32_t count) {
    hs_timeline_json json;
    hs_error err;
    FILE *file = begin_text();
    assert_true(hs_timeline_json_begin(&json, file, "a \"title\"", &v->config, &err));
    for (uint32_t i = 0; i < count; i++)
        assert_true(hs_timeline_json_view(&json, &v[i].t, &err));
    hs_timeline_json_end(&json);
    assert_int_equal(fclose(file), 0);
}

static json_int_t integer(const json_t *event, const char *key) {
    const json_t *value = json_object_get(event, key);
    if (!json_is_integer(value)) fail_msg("an event has no whole %s", key);
    return json_integer_value(value);
}

enum { TRACKS = 64, NEST = 4 };
typedef struct track {
    bool named;
    json_int_t open[NEST]; /* ends of the slices that are open, the outermost first */
    int depth, slices;
} track;

static void check_slice(track *t, json_int_t ts, json_int_t length) {
    assert_true(t->named && length > 0);
    while (t->depth && t->open[t->depth - 1] <= ts)
        t->depth--;
    if (t->depth && ts + length > t->open[t->depth - 1])
        fail_msg("a slice from %lld is not within the one around it", (long long)ts);
    assert_true(t->depth < NEST);
    t->open[t->depth++] = ts + length;
    t->slices++;
}

/* Reads the trace as the format says; the number of its events. */
static size_t check_json(void) {
    json_error_t why;
    json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, &why);
    if (!root) fail_msg("line %d: %s", why.line, why.text);
    assert_string_equal(json_string_value(json_object_get(root, "displayTimeUnit")), "ms");
    const json_t *events = json_object_get(root, "traceEvents"), *event;
    track tracks[TRACKS] = {0};
    json_t *counters = json_object();
    json_int_t now = 0;
    size_t i, names = 0;
    json_array_foreach(events, i, event) {
        const char *phase = json_string_value(json_object_get(event, "ph"));
        const char *name = json_string_value(json_object_get(event, "name"));
        const json_t *args = json_object_get(event, "args");
        assert_true(phase && name && json_is_object(args));
        assert_int_equal(integer(event, "pid"), 1);
        if (*phase == 'M') {
            const json_int_t tid = integer(event, "tid");
            assert_in_range(tid, 0, TRACKS - 1);
            if (strcmp(name, "thread_name") == 0) tracks[tid].named = true;
            names++;
            continue;
        }
        const json_int_t ts = integer(event, "ts");
        if (ts < now) fail_msg("%s at %lld is behind %lld", name, (long long)ts, (long long)now);
        now = ts;
        if (*phase == 'X') {
            const json_int_t tid = integer(event, "tid");
            assert_in_range(tid, 1, TRACKS - 1);
            check_slice(&tracks[tid], ts, integer(event, "dur"));
        } else {
            const char *key;
            json_t *value;
            json_int_t sum = 0;
            assert_string_equal(phase, "C");
            json_object_foreach((json_t *)args, key, value) {
                assert_true(json_is_integer(value) && json_integer_value(value) >= 0);
                sum += json_integer_value(value);
            }
            if (strchr(name, '%')) assert_true(sum <= 101);
            json_object_set_new(counters, name, json_integer(sum));
        }
    }
    const char *key;
    json_t *value;
    json_object_foreach(counters, key, value) if (json_integer_value(value))
        fail_msg("%s does not end with 0", key);
    const json_t *about = json_object_get(root, "otherData");
    assert_string_equal(json_string_value(json_object_get(about, "title")), "a \"title\"");
    assert_int_equal(names, 1 + 2 * (2 + HS_STAGES));
    json_decref(counters);
    json_decref(root);
    return i;
}

static void the_json_is_a_trace_whose_slices_nest(void **state) {
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        taken v;
        take(&v, &samples[i], 3);
        write_json(&v, 1);
        assert_true(check_json() > 30);
        give_back(&v);
    }
}

static void views_follow_one_another_in_one_file(void **state) {
    (void)state;
    taken v[3];
    for (uint32_t i = 0; i < 3; i++)
        take(&v[i], &samples[i], i);
    write_json(v, 1);
    size_t events = check_json();
    write_json(v, 3);
    assert_true(check_json() > events);
    assert_non_null(strstr(text, "\"view 0\""));
    char second[100];
    snprintf(second, sizeof second,
             "{\"name\":\"view 1\",\"ph\":\"X\",\"pid\":1,\"tid\":10,\"ts\":%llu",
             (unsigned long long)(v[0].t.end + HS_TIMELINE_GAP + v[1].t.start));
    if (!strstr(text, second)) fail_msg("no %s", second);
    for (uint32_t i = 0; i < 3; i++)
        give_back(&v[i]);
}

/* --- Kanata -------------------------------------------------------------------------------------
 *
 * A reader of the format, version 4, which knows what may follow what.
 */
enum { GENERATIONS = 12 };

typedef struct insn {
    uint32_t generation;
    bool refined, gone;
    const char *open; /* the part that has begun */
    char parts[40];   /* all of them */
} insn;

typedef struct kanata {
    insn *of;
    size_t count, retired, refined[GENERATIONS], all[GENERATIONS], parts;
    uint64_t cycle;
} kanata;

static uint64_t number_in(char **line) {
    char *end;
    assert_true(isdigit((unsigned char)**line));
    const uint64_t number = strtoull(*line, &end, 10);
    assert_true(end > *line && (*end == '\t' || *end == 0));
    *line = *end ? end + 1 : end;
    return number;
}

static insn *insn_in(kanata *k, char **line) {
    const uint64_t id = number_in(line);
    assert_true(id < k->count);
    assert_false(k->of[id].gone); /* nothing happens behind the end */
    return &k->of[id];
}

static const char *part_in(char *line) {
    static const char *const known[] = {"Wr", "Cl", "Se", "Gu", "Sp", "Nu", "Em"};
    assert_int_equal(number_in(&line), 0); /* the lane */
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i], line) == 0) return known[i];
    fail_msg("no part \"%s\"", line);
    return NULL;
}

static void read_insn(kanata *k, char *line) {
    assert_int_equal(number_in(&line), k->count); /* ids ascend without gaps */
    number_in(&line);
    number_in(&line);
    if ((k->count & (k->count - 1)) == 0)
        k->of = realloc(k->of, (k->count ? 2 * k->count : 1) * sizeof *k->of);
    k->of[k->count++] = (insn){.generation = UINT32_MAX};
}

static void read_label(kanata *k, char *line) {
    insn *of = insn_in(k, &line);
    const uint64_t type = number_in(&line);
    assert_true(type < 2 && *line);
    const char *generation = strstr(line, "generation ");
    if (type == 0) {
        assert_non_null(generation);
        of->generation = (uint32_t)atoi(generation + 11);
        assert_true(of->generation < GENERATIONS && strncmp(line, "view ", 5) == 0);
        k->all[of->generation]++;
    } else {
        const size_t length = strlen(line);
        of->refined = length >= 7 && strcmp(line + length - 7, "refined") == 0;
        k->refined[of->generation] += of->refined;
    }
}

static void read_part(kanata *k, char *line, bool begins) {
    insn *of = insn_in(k, &line);
    const char *part = part_in(line);
    if (begins) {
        assert_null(of->open); /* one part after the other */
        of->open = part;
        assert_null(strstr(of->parts, part));
        strncat(of->parts, part, sizeof of->parts - strlen(of->parts) - 1);
        k->parts++;
    } else {
        assert_ptr_equal(of->open, part); /* it has begun, and before it ends */
        of->open = NULL;
    }
}

static void read_end(kanata *k, char *line) {
    insn *of = insn_in(k, &line);
    assert_int_equal(number_in(&line), k->retired++);
    assert_int_equal(number_in(&line), 0);
    assert_null(of->open);
    of->gone = true;
}

static kanata read_kanata(void) {
    kanata k = {0};
    char *rest = text, *line;
    assert_true(text_size && text[text_size - 1] == '\n');
    assert_string_equal(strsep(&rest, "\n"), "Kanata\t0004");
    assert_string_equal(strsep(&rest, "\n"), "C=\t0");
    while ((line = strsep(&rest, "\n")) && rest) {
        assert_int_equal(line[1], '\t');
        char *fields = line + 2;
        switch (line[0]) {
        case 'C': {
            const uint64_t cycles = number_in(&fields);
            assert_true(cycles > 0);
            k.cycle += cycles;
            break;
        }
        case 'I':
            read_insn(&k, fields);
            break;
        case 'L':
            read_label(&k, fields);
            break;
        case 'S':
        case 'E':
            read_part(&k, fields, line[0] == 'S');
            break;
        case 'R':
            read_end(&k, fields);
            break;
        default:
            fail_msg("no command \"%s\"", line);
        }
    }
    assert_int_equal(k.retired, k.count); /* who enters leaves */
    return k;
}

static void write_kanata(const taken *v, uint32_t count) {
    hs_timeline_kanata kanata;
    hs_error err;
    FILE *file = begin_text();
    hs_timeline_kanata_begin(&kanata, file);
    for (uint32_t i = 0; i < count; i++)
        assert_true(hs_timeline_kanata_view(&kanata, &v[i].t, &err));
    assert_int_equal(fclose(file), 0);
}

/* The way of a quad: which parts, in which order, hangs on what the sequencer starts. */
static void assert_way(const insn *of, const hs_settings *s) {
    static const char *const ways[] = {
        "WrClSeGuSpNu", "WrClSeGuSpNuEm",
        "WrClSeSpNuEm", /* all; what sends; nothing is selected */
        "WrClSpNuEm",   "WrClSpNu",
        "WrClGuSpNu", /* uniform */
        "WrSpNu",       "WrSpNuEm",
        "WrClGuSpNuEm", /* uniform, without classify; generation 0 */
    };
    size_t i = 0;
    while (i < sizeof ways / sizeof *ways && strcmp(ways[i], of->parts) != 0)
        i++;
    if (i == sizeof ways / sizeof *ways || (i >= 5 && !s->uniform)) fail_msg("way %s", of->parts);
}

static void every_quad_enters_once_and_leaves(void **state) {
    (void)state;
    size_t quads = 0;
    for (int i = 0; i < SAMPLES; i++) {
        taken v;
        take(&v, &samples[i], 3);
        write_kanata(&v, 1);
        kanata k = read_kanata();
        assert_true(k.cycle < v.cycles.end - v.cycles.begin + 1);
        if (refused(&v)) assert_int_equal(k.count, 0);
        for (uint32_t g = 0; g < v.t.generations && !refused(&v); g++) {
            const hs_generation *golden = &v.report.generation[g];
            assert_int_equal(k.all[g], g ? golden->active : golden->corners);
            if (g) assert_int_equal(k.refined[g], golden->refined);
        }
        for (size_t q = 0; q < k.count; q++)
            assert_way(&k.of[q], &samples[i].settings);
        quads += k.count;
        free(k.of);
        give_back(&v);
    }
    assert_true(quads > 10000);
}

static void ids_go_on_from_view_to_view(void **state) {
    (void)state;
    taken v[3];
    for (uint32_t i = 0; i < 3; i++)
        take(&v[i], &samples[i + 14], i); /* the last one is refused */
    write_kanata(v, 3);
    kanata k = read_kanata();
    size_t quads = 0;
    for (uint32_t i = 0; i < 2; i++)
        for (uint32_t g = 0; g < v[i].t.generations; g++)
            quads += v[i].t.generation[g].items;
    assert_int_equal(k.count, quads);
    assert_true(k.cycle > v[0].t.end);
    free(k.of);
    for (uint32_t i = 0; i < 3; i++)
        give_back(&v[i]);
}

/* --- SVG ----------------------------------------------------------------------------------------
 */

/* Elements open and close in turn, attributes are quoted, texts are escaped. */
static void check_svg(void) {
    char open[20][20];
    int depth = 0, elements = 0;
    for (const char *c = text; *c; c++) {
        if (*c == '&') {
            assert_true(strncmp(c, "&lt;", 4) == 0 || strncmp(c, "&gt;", 4) == 0 ||
                        strncmp(c, "&amp;", 5) == 0);
        } else if (*c == '<') {
            const bool closes = c[1] == '/';
            const size_t length = strcspn(c + 1 + closes, " />\n");
            assert_true(length > 0 && length < 20);
            const char *name = c + 1 + closes, *end = name + length;
            for (bool quoted = false; *end && (quoted || *end != '>'); end++)
                quoted ^= *end == '"';
            assert_int_equal(*end, '>');
            if (closes) {
                assert_true(depth-- > 0);
                assert_true(strlen(open[depth]) == length &&
                            strncmp(open[depth], name, length) == 0);
            } else if (end[-1] != '/') {
                assert_true(depth < 20);
                snprintf(open[depth++], 20, "%.*s", (int)length, name);
            }
            elements++;
            c = end;
        } else {
            assert_true(depth > 0 || *c == '\n');
            assert_int_not_equal(*c, '>');
        }
    }
    assert_int_equal(depth, 0);
    assert_true(elements > 50);
}

static void the_svg_is_well_formed_and_small(void **state) {
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        taken v;
        take(&v, &samples[i], 3);
        FILE *file = begin_text();
        hs_timeline_svg(file, &v.t, "<a & b> \x01\xff");
        assert_int_equal(fclose(file), 0);
        check_svg();
        assert_true(text_size < 150000);
        assert_non_null(strstr(text, "&lt;a &amp; b&gt; ??"));
        assert_null(strstr(text, "nan"));
        give_back(&v);
    }
}

/* --- What makes no sense ------------------------------------------------------------------------
 */

/* A log of an RTL that is broken may hold anything. */
static void a_log_without_sense_is_no_danger(void **state) {
    (void)state;
    uint64_t random = random_state(5);
    for (uint32_t round = 0; round < 300; round++) {
        taken v = {.config = HS_DEFAULT_CONFIG};
        hs_error err = {0};
        if (round % 2) take(&v, &samples[round / 2 % SAMPLES], 3);
        hs_timeline_free(&v.t);
        if (!(round % 2)) v.cycles = (hs_cycle_report){.end = random_below(&random, 100000)};
        for (uint32_t p = 0; p < HS_PROBES; p++)
            for (uint32_t i = random_below(&random, 30); i > 0; i--) {
                uint32_t word[4];
                for (int k = 0; k < 4; k++)
                    word[k] = random_bits(&random) >> random_below(&random, 32);
                const size_t count = v.log.probe[p].count;
                if (count && i % 2) /* one that is there, spoilt */
                    memcpy(v.log.probe[p].transaction[random_below(&random, (uint32_t)count)].word,
                           word, sizeof word);
                else
                    hs_log_add(&v.log, p,
                               i % 3 ? random_below(&random, 100000)
                                     : (uint64_t)random_bits(&random) << random_below(&random, 32),
                               random_bits(&random) >> random_below(&random, 32), word);
            }
        const hs_timeline_source source = {
            .log = &v.log, .cycles = &v.cycles, .config = v.config, .limit = round % 5 == 0};
        assert_true(hs_timeline_make(&v.t, &source, &err));
        write_json(&v, 1);
        json_t *root = json_loads(text, 0, NULL);
        assert_non_null(root);
        json_decref(root);
        write_kanata(&v, 1);
        FILE *file = begin_text();
        hs_timeline_svg(file, &v.t, "");
        fclose(file);
        give_back(&v);
    }
}

static int tear_down(void **state) {
    (void)state;
    free(text);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_json_is_a_trace_whose_slices_nest),
        cmocka_unit_test(views_follow_one_another_in_one_file),
        cmocka_unit_test(every_quad_enters_once_and_leaves),
        cmocka_unit_test(ids_go_on_from_view_to_view),
        cmocka_unit_test(the_svg_is_well_formed_and_small),
        cmocka_unit_test(a_log_without_sense_is_no_danger),
    };
    return cmocka_run_group_tests_name("timeline_files", tests, NULL, tear_down);
}
