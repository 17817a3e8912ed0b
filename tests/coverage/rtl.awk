# SPDX-License-Identifier: Apache-2.0
#
# awk -f rtl.awk EXCLUSIONS COUNTS...: the coverage of rtl/*.sv by Verilator's files of counts, as a table of
# modules and a list of what is not covered.
#
#   * A point is a line's block, a branch, or a bit that toggles; it is named by file, line, column and what
#     Verilator says of it. It is covered if any instance in any simulation covered it.
#   * A line of EXCLUSIONS is: KIND FILE PATTERN REASON, KIND lines or toggles, PATTERN a regular expression
#     without blanks for the whole of a toggle's name, or for "LINE TEXT" of the source line. One that excludes
#     nothing, or has no reason, is an error.
#   * Lines are Verilator's blocks and branches; both count.
#
# Sets the exit status: 1 if a target (lines=, toggles= in per cent) is missed or nothing was measured.

function source(file, line,    text, n) {
    if (!(file in loaded)) {
        loaded[file] = 1
        while ((getline text < file) > 0) sources[file, ++n] = text
        close(file)
    }
    text = sources[file, line]
    gsub(/^[ \t]+|[ \t]+$/, "", text)
    return text
}

# The value that follows a key: Verilator writes \001KEY\002VALUE.
function field(key,    at, rest) {
    at = index($0, "\001" key "\002")
    if (!at) return ""
    rest = substr($0, at + length(key) + 2)
    match(rest, /[\001']/)
    return substr(rest, 1, RSTART - 1)
}

# The keys of a set in order, from 1; returns how many.
function ordered(set, to,    n, key, gap, i, j) {
    for (key in set) to[++n] = key
    for (gap = int(n / 2); gap > 0; gap = int(gap / 2))
        for (i = gap + 1; i <= n; i++) {
            key = to[i]
            for (j = i; j > gap && to[j - gap] > key; j -= gap) to[j] = to[j - gap]
            to[j] = key
        }
    return n + 0
}

function percent(covered, total) { return total ? 100 * covered / total : 100 }

function excluded(kind, file, what,    i) {
    for (i = 1; i <= exclusions; i++)
        if (ex_kind[i] == kind && file ~ "^(rtl/)?(" ex_file[i] ")$" && what ~ "^(" ex_pattern[i] ")$") {
            ex_used[i]++
            return 1
        }
    return 0
}

FILENAME != latest { latest = FILENAME; files++ }
files == 1 {
    if ($0 ~ /^#/ || NF == 0) next
    exclusions++
    ex_kind[exclusions] = $1; ex_file[exclusions] = $2; ex_pattern[exclusions] = $3
    if (NF < 5) { print "exclusion without a reason: " $0; bad = 1 }
    next
}
/^C / {
    file = field("f")
    if (file !~ /(^|\/)rtl\/[a-z0-9_]+\.sv$/) next
    sub(/.*rtl\//, "rtl/", file)
    kind = field("page") ~ /^v_toggle/ ? "toggles" : "lines"
    key = kind SUBSEP file SUBSEP field("l") SUBSEP field("n") SUBSEP field("o")
    count[key] += $NF
}
END {
    for (key in count) {
        split(key, part, SUBSEP)
        kind = part[1]; file = part[2]; line = part[3]; what = part[5]
        modules[file] = 1
        if (count[key] > 0) { covered[kind, file]++; total[kind, file]++; continue }
        name = kind == "toggles" ? what : line " " source(file, line)
        if (excluded(kind, file, name)) { out[kind]++; out_of[kind, file]++; continue }
        total[kind, file]++
        missing[file "\t" sprintf("%05d", line) "\t" kind "\t" what] = 1
    }
    # A module that nobody measured would otherwise count as no module at all.
    while (("ls rtl/*.sv" | getline file) > 0)
        if (file != "rtl/hs_pkg.sv" && !(file in modules)) { print "not measured: " file "\n"; bad = 1 }
    print "| module | lines and branches | covered | excluded | toggles | covered | excluded |"
    print "|---|--:|--:|--:|--:|--:|--:|"
    n = ordered(modules, names)
    for (i = 1; i <= n; i++) {
        f = names[i]
        printf "| %s | %d | %.1f%% | %d | %d | %.1f%% | %d |\n", f, total["lines", f],
            percent(covered["lines", f], total["lines", f]), out_of["lines", f], total["toggles", f],
            percent(covered["toggles", f], total["toggles", f]), out_of["toggles", f]
        for (k = 1; k <= 2; k++) {
            kind = k == 1 ? "lines" : "toggles"
            all[kind] += total[kind, f]; done[kind] += covered[kind, f]
        }
    }
    print "\nNot covered:\n"
    n = ordered(missing, gaps)
    previous = ""
    for (i = 1; i <= n; i++) {
        split(gaps[i], part, "\t")
        place = part[1] ":" part[2] + 0
        if (part[3] == "lines") { text = place " (" part[4] "): `" source(part[1], part[2] + 0) "`" }
        else { text = place ": toggle of " part[4] }
        # The bits of one signal on one line of the page.
        signal = part[4]; bit = ""
        if (match(signal, /\[[0-9]+\]$/)) { bit = substr(signal, RSTART + 1, RLENGTH - 2); signal = substr(signal, 1, RSTART - 1) }
        if (part[3] == "toggles") {
            group = place ": toggle of " signal
            if (group == previous) { printf " %s", bit; continue }
            text = group (bit == "" ? "" : ", bits " bit)
            previous = group
        } else previous = ""
        printf "%s* %s", (i > 1 ? "\n" : ""), text
    }
    if (n) print ""
    else print "Nothing."
    for (i = 1; i <= exclusions; i++)
        if (!ex_used[i]) { printf "exclusion of nothing: %s %s %s\n", ex_kind[i], ex_file[i], ex_pattern[i]; bad = 1 }
    for (k = 1; k <= 2; k++) {
        kind = k == 1 ? "lines" : "toggles"
        p = percent(done[kind], all[kind]); target = kind == "lines" ? lines : toggles
        printf "result: rtl %s %.2f%% (%d of %d, target %s%%), %d excluded\n", (kind == "lines" ? "lines and branches" : kind), p,
            done[kind], all[kind], target, out[kind]
        if (all[kind] == 0 || p < target) bad = 1
    }
    exit bad
}
