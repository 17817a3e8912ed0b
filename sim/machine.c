/* SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE /* sched_getaffinity */
#include "machine.h"

#include <sched.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

#ifdef __clang__
#define COMPILER __VERSION__ /* begins with its name */
#else
#define COMPILER "gcc " __VERSION__
#endif
hs_program_info hs_program = {"halfstep", "unknown", COMPILER, "unknown"};

/* The first line "model name : TEXT". */
static void read_processor(char *text, size_t size) {
    FILE *file = fopen("/proc/cpuinfo", "r");
    char line[400];
    text[0] = 0;
    while (file && !text[0] && fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (!colon || strncmp(line, "model name", 10) != 0) continue;
        snprintf(text, size, "%s", colon + 1 + strspn(colon + 1, " "));
        text[strcspn(text, "\n")] = 0;
    }
    if (file) fclose(file);
}

void hs_machine_read(hs_machine *machine) {
    struct utsname name;
    *machine = (hs_machine){.system = "unknown"};
    if (uname(&name) == 0)
        snprintf(machine->system, sizeof machine->system, "%s %s %s", name.sysname, name.release,
                 name.machine);
    read_processor(machine->processor, sizeof machine->processor);
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) machine->cores = (uint32_t)CPU_COUNT(&set);
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    if (pages > 0 && size > 0) machine->memory = (uint64_t)pages * (uint64_t)size;
}
