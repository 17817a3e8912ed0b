/* SPDX-License-Identifier: Apache-2.0
 *
 * Mutants of C code: small changes of one place each, inside functions.
 *
 *   mutate list SEED FILE      a line for each: key, id, line, what is changed, the line's text;
 * with tabs. The key is a hash of the seed and of what is changed, not of where it stands: sorted
 * by it, the mutants are in a random order that does not depend on other lines. mutate apply ID
 * FILE       the file with that mutant, on stdout
 *
 * The file is read as tokens, without knowing types: a mutant may not compile. Operators: relations
 * (negated, and with their bound moved), arithmetic, bits, logic, constants one up and one down,
 * true and false, conditions negated, statements deleted, values returned as 0.
 */
#include <ctype.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TOKENS = 1 << 16, MOST_DEPTH = 256 };

typedef enum { WORD, NUMBER, TEXT, SIGN } kind;
typedef struct {
    const char *at;
    size_t length;
    uint32_t line;
    kind kind;
} token;

/* One mutant: `length` characters at `at` become `by`. */
typedef struct {
    const char *at;
    size_t length;
    const char *by;
} change;

static char *source;
static token tokens[MOST_TOKENS];
static uint32_t count;

/* What is done with the mutants. */
static uint64_t seed;
static uint32_t wanted, found;
static bool listing, applied;

static bool is(const token *t, const char *text) {
    return strlen(text) == t->length && memcmp(t->at, text, t->length) == 0;
}

static bool is_one_of(const token *t, const char *const *texts) {
    for (; *texts; texts++)
        if (is(t, *texts)) return true;
    return false;
}

/* --- Tokens -------------------------------------------------------------------------------------
 */
static const char *skip_comment(const char *c) {
    if (c[1] == '/') return c + strcspn(c, "\n");
    const char *end = strstr(c + 2, "*/");
    return end ? end + 2 : c + strlen(c);
}

static const char *skip_quoted(const char *c) {
    const char quote = *c++;
    while (*c && *c != quote)
        c += *c == '\\' && c[1] ? 2 : 1;
    return *c ? c + 1 : c;
}

static const char *skip_directive(const char *c) {
    while (*c && *c != '\n')
        c += *c == '\\' && c[1] ? 2 : 1;
    return c;
}

static size_t sign_length(const char *c) {
    static const char *const signs[] = {"<<=", ">>=", "...", "->", "++", "--", "<<", ">>",
                                        "<=",  ">=",  "==",  "!=", "&&", "||", "+=", "-=",
                                        "*=",  "/=",  "%=",  "&=", "|=", "^="};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (strncmp(c, signs[i], strlen(signs[i])) == 0) return strlen(signs[i]);
    return 1;
}

static void read_tokens(void) {
    uint32_t line = 1;
    bool fresh = true; /* nothing but blanks so far on this line */
    for (const char *c = source; *c;) {
        const char *end = c + 1;
        kind k = SIGN;
        bool kept = false;
        if (*c == '\n') {
            fresh = true;
            line++;
            c++;
            continue;
        }
        if (isspace((unsigned char)*c)) {
            c++;
            continue;
        }
        if (*c == '#' && fresh) {
            end = skip_directive(c);
        } else if (*c == '/' && (c[1] == '/' || c[1] == '*')) {
            end = skip_comment(c);
        } else {
            kept = true;
            if (*c == '"' || *c == '\'') {
                end = skip_quoted(c);
                k = TEXT;
            } else if (isalpha((unsigned char)*c) || *c == '_') {
                while (isalnum((unsigned char)*end) || *end == '_')
                    end++;
                k = WORD;
            } else if (isdigit((unsigned char)*c)) {
                while (isalnum((unsigned char)*end) || *end == '.')
                    end++;
                k = NUMBER;
            } else {
                end = c + sign_length(c);
            }
        }
        fresh = false;
        if (kept) {
            if (count == MOST_TOKENS) {
                fprintf(stderr, "mutate: more than %d tokens\n", MOST_TOKENS);
                exit(2);
            }
            tokens[count++] = (token){c, (size_t)(end - c), line, k};
        }
        for (; c < end; c++)
            line += *c == '\n';
    }
}

/* --- Mutants ------------------------------------------------------------------------------------
 */
static uint64_t hash(uint64_t h, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++)
        h = (h ^ (unsigned char)text[i]) * 0x100000001b3u;
    return h;
}

/* Text on one line, blanks in a row as one. */
static void put(const char *text, size_t length) {
    bool blank = false;
    for (size_t i = 0; i < length; i++) {
        if (isspace((unsigned char)text[i])) {
            blank = true;
        } else {
            if (blank) putchar(' ');
            blank = false;
            putchar(text[i]);
        }
    }
}

static void list(const change *c, uint32_t line) {
    const char *begin = c->at, *end = c->at + strcspn(c->at, "\n");
    while (begin > source && begin[-1] != '\n')
        begin--;
    while (isspace((unsigned char)*begin) && begin < c->at)
        begin++;
    uint64_t h = hash(0xcbf29ce484222325u ^ seed, begin, (size_t)(end - begin));
    h = hash(h, (const char *)&(uint32_t){(uint32_t)(c->at - begin)}, 4);
    h = hash(h, c->by, strlen(c->by));
    h ^= h >> 29; /* the low bits of the last characters reach the high ones */
    h *= 0xbf58476d1ce4e5b9u;
    h ^= h >> 32;
    printf("%016" PRIx64 "\t%u\t%u\t", h, found, line);
    put(c->at, c->length);
    printf(" => %s", c->by);
    uint32_t before = 0; /* the same text further left */
    for (const char *other = begin; other < c->at; other++)
        before += memcmp(other, c->at, c->length) == 0;
    if (before) printf(", no. %u", before + 1);
    putchar('\t');
    put(begin, (size_t)(end - begin));
    putchar('\n');
}

static void mutant(const char *at, size_t length, const char *by, uint32_t line) {
    const change c = {at, length, by};
    if (listing) list(&c, line);
    if (!listing && found == wanted) {
        fwrite(source, 1, (size_t)(at - source), stdout);
        fputs(by, stdout);
        fputs(at + length, stdout);
        applied = true;
    }
    found++;
}

static void replace(const token *t, const char *by) {
    mutant(t->at, t->length, by, t->line);
}

/* The token stands where an operand has ended: a sign behind it has two operands. */
static bool ends_operand(const token *t) {
    static const char *const words[] = {"return", "case", "sizeof", "else", "do", NULL};
    return t->kind == NUMBER || (t->kind == WORD && !is_one_of(t, words)) || is(t, ")") ||
           is(t, "]");
}

static void mutate_sign(const token *t) {
    static const char *const two[][2] = {
        {"<", "<="},  {"<", ">="},  {"<=", "<"},    {"<=", ">"},    {">", ">="},  {">", "<="},
        {">=", ">"},  {">=", "<"},  {"==", "!="},   {"!=", "=="},   {"+", "-"},   {"-", "+"},
        {"*", "+"},   {"/", "*"},   {"%", "/"},     {"<<", ">>"},   {">>", "<<"}, {"&", "|"},
        {"|", "&"},   {"^", "|"},   {"&&", "||"},   {"||", "&&"},   {"+=", "-="}, {"-=", "+="},
        {"|=", "&="}, {"&=", "|="}, {"<<=", ">>="}, {">>=", "<<="}, {"^=", "|="}};
    if (is(t, "!")) replace(t, "");
    if (is(t, "++")) replace(t, "--");
    if (is(t, "--")) replace(t, "++");
    if (!ends_operand(t - 1)) return;
    for (size_t i = 0; i < sizeof two / sizeof *two; i++)
        if (is(t, two[i][0])) replace(t, two[i][1]);
}

static void mutate_number(const token *t) {
    char text[80];
    if (t->length > 60 || memchr(t->at, '.', t->length)) return;
    snprintf(text, sizeof text, "(%.*s + 1)", (int)t->length, t->at);
    replace(t, text);
    snprintf(text, sizeof text, "(%.*s - 1)", (int)t->length, t->at);
    if (*t->at != '0' || t->length > 2) replace(t, text);
}

/* From a statement's first token: deleted if it is an assignment, a call or a jump; a value that it
 * returns becomes 0. */
static void mutate_statement(uint32_t i) {
    static const char *const kept[] = {"if",     "for",  "while",  "do",      "switch",
                                       "case",   "else", "const",  "static",  "default",
                                       "struct", "enum", "return", "typedef", NULL};
    const token *t = &tokens[i], *end = t;
    int depth = 0;
    while (end < &tokens[count - 1] && !(depth == 0 && is(end, ";"))) {
        depth += is(end, "(") || is(end, "{") || is(end, "[");
        depth -= is(end, ")") || is(end, "}") || is(end, "]");
        if (depth < 0) return;
        end++;
    }
    const bool returned = is(t, "return");
    if (returned && end > t + 1 && t[1].kind != NUMBER && !is(t + 1, "true") && !is(t + 1, "false"))
        mutant(t[1].at, (size_t)(end->at - t[1].at), "0", t[1].line);
    /* A declaration: two words, or a star between them. */
    const token *second = t[1].kind == SIGN && is(t + 1, "*") ? t + 2 : t + 1;
    if (t->kind == WORD && second->kind == WORD && !is(t, "goto")) return;
    if (t->kind == WORD ? is_one_of(t, kept) : !is(t, "*") && !is(t, "++")) return;
    mutant(t->at, (size_t)(end->at - t->at), "", t->line);
}

/* The condition of an if or a while, from its parenthesis on. */
static void mutate_condition(uint32_t i) {
    char text[4000];
    uint32_t depth = 0, end = i;
    for (; end < count; end++) {
        depth += is(&tokens[end], "(");
        depth -= is(&tokens[end], ")");
        if (depth == 0) break;
    }
    if (end == count) return;
    const size_t length = (size_t)(tokens[end].at + 1 - tokens[i].at);
    if (length + 8 > sizeof text) return;
    snprintf(text, sizeof text, "(!%.*s)", (int)length, tokens[i].at);
    for (char *c = text; *c; c++) /* comments to the line's end are not the style here */
        if (*c == '\n') *c = ' ';
    mutant(tokens[i].at, length, text, tokens[i].line);
}

static void mutate_all(void) {
    static const char *const heads[] = {"if", "for", "while", "switch", NULL};
    int braces = 0;
    bool inside = false; /* a function's body */
    bool head[MOST_DEPTH] = {false};
    int depth = 0; /* of parentheses */
    bool begins = false;
    for (uint32_t i = 0; i < count; i++) {
        const token *t = &tokens[i];
        if (is(t, "{")) {
            if (braces == 0) inside = i > 0 && is(t - 1, ")");
            braces++;
        }
        if (is(t, "}") && --braces == 0) inside = false;
        if (is(t, "(") && depth + 1 < MOST_DEPTH) head[++depth] = i > 0 && is_one_of(t - 1, heads);
        if (inside) {
            if (begins && t->kind != TEXT && !is(t, "{") && !is(t, "}")) mutate_statement(i);
            if (is(t, "(") && (is(t - 1, "if") || is(t - 1, "while"))) mutate_condition(i);
            if (t->kind == SIGN) mutate_sign(t);
            if (t->kind == NUMBER) mutate_number(t);
            if (is(t, "true")) replace(t, "false");
            if (is(t, "false")) replace(t, "true");
        }
        begins = depth == 0 && (is(t, ";") || is(t, "{") || is(t, "}") || is(t, "else"));
        if (is(t, ")") && depth > 0) begins = head[depth--] && depth == 0;
    }
}

static void read_source(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        fprintf(stderr, "mutate: %s: cannot be read\n", path);
        exit(2);
    }
    const size_t room = 1 << 20;
    source = calloc(1, room + 1);
    if (!source || fread(source, 1, room, file) == room) exit(2);
    fclose(file);
}

int main(int argc, char **argv) {
    listing = argc == 4 && strcmp(argv[1], "list") == 0;
    if (argc != 4 || (!listing && strcmp(argv[1], "apply") != 0)) {
        fprintf(stderr, "usage: mutate list SEED FILE | mutate apply ID FILE\n");
        return 2;
    }
    seed = strtoull(argv[2], NULL, 0);
    wanted = (uint32_t)seed;
    read_source(argv[3]);
    read_tokens();
    mutate_all();
    return listing ? found == 0 : !applied;
}
