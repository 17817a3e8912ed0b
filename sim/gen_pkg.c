/* SPDX-License-Identifier: Apache-2.0
 *
 * Writes what others need to know of model/definitions.def in their own language:
 *
 *   gen_pkg sv   rtl/hs_pkg.sv, the RTL's package of constants
 *   gen_pkg md   docs/reference.md, the tables for readers
 *
 * Both go to standard output. They are kept in the tree; the Makefile writes them anew when
 * definitions.def changes. Exit codes are the tool's own: HS_EXIT_USAGE, HS_EXIT_FILE.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "definitions.h"

enum kind { CONSTANTS, RECORDS, STATUSES, STAGES, ACTIVITIES, REGISTERS, PROBES, EXITS, KINDS };

struct entry {
    enum kind kind;
    const char *name;
    const char *literal; /* the value as definitions.def writes it */
    uint32_t value;
    const char *what;
    const char *more; /* a status' remedy, a register's access, a boundary's stage */
};

#define CONSTANT(name, value, what)           {CONSTANTS, #name, #value, (uint32_t)value, what, ""},
#define RECORD(name, value, what)             {RECORDS, #name, #value, value, what, ""},
#define STATUS(name, value, what, remedy)     {STATUSES, #name, #value, value, what, remedy},
#define STAGE(name, index, what)              {STAGES, #name, #index, index, what, ""},
#define ACTIVITY(name, index, what)           {ACTIVITIES, #name, #index, index, what, ""},
#define REGISTER(name, address, access, what) {REGISTERS, #name, #address, address, what, access},
#define PROBE(name, index, stage, what)       {PROBES, #name, #index, index, what, #stage},
#define EXIT(name, value, what)               {EXITS, #name, #value, value, what, ""},

static const struct entry entries[] = {
#include "definitions.def"
};
enum { ENTRIES = sizeof entries / sizeof entries[0] };

/* How a kind looks in the package: width 0 means that the RTL has no use for it. */
static const struct {
    const char *prefix;
    int width;
    const char *title;  /* of its section in the tables */
    const char *header; /* of its table */
} kinds[KINDS] = {
    [CONSTANTS] = {"", 32, "Constants", "| name | value | what |"},
    [RECORDS] = {"RECORD_", 3, "Output records", "| name | kind | what |"},
    [STATUSES] = {"STATUS_", 8, "Statuses of a view", "| name | status | what | what to do |"},
    [STAGES] = {"STAGE_", 4, "Stages", "| name | index | what |"},
    [ACTIVITIES] = {"ACTIVITY_", 2, "Activities of a stage", "| name | index | what |"},
    [REGISTERS] = {"REG_", 12, "Registers", "| name | address | access | what |"},
    [PROBES] = {"PROBE_", 32, "Stage boundaries", "| name | index | stage | what passes |"},
    [EXITS] = {"EXIT_", 0, "Exit codes of the command-line tool", "| name | code | what |"},
};

static uint32_t count(enum kind kind) {
    uint32_t n = 0;
    for (int i = 0; i < ENTRIES; i++)
        n += entries[i].kind == kind;
    return n;
}

/* The table of rtl/divide.sv: for each denominator its s, with 2^16 < d <= 2^17 for d = denominator
 * 2^s, and r = ceil(2^64 / d). Entry {limit, n} is at bit 53 (256 limit + n); n = 0 stands for
 * nothing. */
static void write_reciprocals(FILE *out) {
    fputs("\n  // --- Division by n^2, and for limits by n^2 + 5n; see divide.sv.\n"
          "  // {s[4:0], r[47:0]} for {limit, n} from 511 down to 0\n"
          "  localparam logic [53*512-1:0] RECIPROCALS = {\n",
          out);
    for (uint32_t entry = 512; entry-- > 0;) {
        const uint64_t n = entry % 256;
        uint64_t d = n ? n * n + (entry >= 256 ? 5 * n : 0) : 1, s = 0;
        while (d << s <= 65536)
            s++;
        d <<= s;
        const uint64_t r = (uint64_t)((((unsigned __int128)1 << 64) + d - 1) / d);
        fprintf(out, "%s53'h%014" PRIx64 "%s", entry % 4 == 3 ? "    " : " ", s << 48 | r,
                entry == 0       ? "\n  };\n"
                : entry % 4 == 0 ? ",\n"
                                 : ",");
    }
}

static void write_package(FILE *out) {
    fputs("// SPDX-License-Identifier: Apache-2.0\n"
          "//\n"
          "// The numbers that C and SystemVerilog share. Written by build/gen_pkg from\n"
          "// model/definitions.def: change them there.\n\n"
          "/* verilator lint_off UNUSEDPARAM */\n"
          "package hs_pkg;\n",
          out);
    for (int k = 0; k < KINDS; k++) {
        if (kinds[k].width == 0) continue;
        fprintf(out, "\n  // --- %s\n", kinds[k].title);
        for (int i = 0; i < ENTRIES; i++) {
            const struct entry *e = &entries[i];
            if ((int)e->kind != k) continue;
            fprintf(out, "  // %s\n", e->what);
            int width = kinds[k].width;
            fprintf(out, "  localparam logic [%d:0] %s%s = ", width - 1, kinds[k].prefix, e->name);
            if (strncmp(e->literal, "0x", 2) == 0)
                fprintf(out, "%d'h%0*" PRIx32 ";\n", width, (width + 3) / 4, e->value);
            else
                fprintf(out, "%d'd%" PRIu32 ";\n", width, e->value);
        }
        if (k == STAGES || k == ACTIVITIES)
            fprintf(out,
                    "  // how many there are\n  localparam logic [31:0] %s = 32'd%" PRIu32 ";\n",
                    k == STAGES ? "STAGES" : "ACTIVITIES", count((enum kind)k));
    }
    write_reciprocals(out);
    fputs("\nendpackage\n/* verilator lint_on UNUSEDPARAM */\n", out);
}

/* A cell of a table; the bar would end it. */
static void write_cell(FILE *out, const char *text) {
    fputc(' ', out);
    for (; *text; text++) {
        if (*text == '|') fputc('\\', out);
        fputc(*text, out);
    }
    fputs(" |", out);
}

static void write_tables(FILE *out) {
    fputs("<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
          "<!-- Written by build/gen_pkg from model/definitions.def: change it there. -->\n\n"
          "# Reference\n\n"
          "Every number that the C code, the RTL and their users share. C calls them `HS_NAME`,\n"
          "`HS_RECORD_NAME`, `HS_STATUS_NAME` and so on (model/definitions.h); the RTL\n"
          "`hs_pkg::NAME`, `hs_pkg::RECORD_NAME` and so on (rtl/hs_pkg.sv).\n",
          out);
    for (int k = 0; k < KINDS; k++) {
        fprintf(out, "\n## %s\n\n%s\n", kinds[k].title, kinds[k].header);
        for (const char *c = kinds[k].header; *c; c++)
            if (c[0] == '|') fputs(c[1] ? "|---" : "|\n", out);
        for (int i = 0; i < ENTRIES; i++) {
            const struct entry *e = &entries[i];
            if ((int)e->kind != k) continue;
            fprintf(out, "| `%s%s` | %s |", kinds[k].prefix, e->name, e->literal);
            if (k == REGISTERS || k == PROBES) write_cell(out, e->more);
            write_cell(out, e->what);
            if (k == STATUSES) write_cell(out, *e->more ? e->more : "nothing");
            fputc('\n', out);
        }
    }
    fputs(
        "\nThe counters of stage s begin at `REG_STAGES` + 32 s: busy, starved, blocked and idle\n"
        "cycles, items in, items out, a 32-bit word each.\n",
        out);
}

int main(int argc, char **argv) {
    if (argc == 2 && strcmp(argv[1], "sv") == 0) {
        write_package(stdout);
    } else if (argc == 2 && strcmp(argv[1], "md") == 0) {
        write_tables(stdout);
    } else {
        fputs("usage: gen_pkg sv|md (rtl/hs_pkg.sv or docs/reference.md to standard output)\n",
              stderr);
        return HS_EXIT_USAGE;
    }
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fputs("gen_pkg: standard output: cannot write; is the disk full?\n", stderr);
        return HS_EXIT_FILE;
    }
    return 0;
}
