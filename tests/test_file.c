/* SPDX-License-Identifier: Apache-2.0
 *
 * Files appear whole or not at all, and are read whole or not at all.
 */
#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "definitions.h"
#include "file.h"
#include "folder.h"

static void write_file(const char *path, const char *text) {
    hs_file file;
    hs_error err;
    if (!hs_file_create(&file, path, &err)) fail_msg("%s", err.text);
    fputs(text, file.stream);
    if (!hs_file_commit(&file, &err)) fail_msg("%s", err.text);
}

static void a_file_appears_only_when_it_is_committed(void **state) {
    (void)state;
    folder f = make_folder();
    const char *path = inside(&f, "a");
    hs_file file;
    hs_error err;
    assert_true(hs_file_create(&file, path, &err));
    fputs("text", file.stream);
    assert_int_equal(access(path, F_OK), -1);
    hs_file_abandon(&file);
    hs_file_abandon(&file);
    assert_int_equal(count_entries(&f), 0);

    write_file(path, "one");
    assert_content(path, "one");
    assert_true(hs_file_create(&file, path, &err) && hs_file_beside(&file, ".more", &err));
    write_file(file.beside, "more");
    fputs("two", file.stream);
    fflush(file.stream);
    assert_content(path, "one");
    assert_true(hs_file_commit(&file, &err));
    assert_content(path, "two");
    assert_null(file.stream);
    assert_int_equal(count_entries(&f), 1);

    const char *link = inside(&f, "link");
    assert_int_equal(symlink("a", link), 0);
    write_file(link, "three");
    assert_content(path, "three");
    assert_int_equal(count_entries(&f), 2);
    unlink(link);
    unlink(path);
    assert_int_equal(rmdir(f.path), 0);
}

/* As a signal's handler has it: another thread may be about to begin a file. */
static void a_process_that_ends_leaves_no_temporary_file(void **state) {
    (void)state;
    folder f = make_folder();
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        hs_file before, behind;
        hs_error err;
        const bool begun = hs_file_create(&before, inside(&f, "before"), &err) &&
                           hs_file_beside(&before, ".more", &err);
        if (begun) write_file(before.beside, "more");
        hs_file_remove_all();
        _exit(!begun || hs_file_create(&behind, inside(&f, "behind"), &err));
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_int_equal(count_entries(&f), 0);
    assert_int_equal(remove_folder(&f), 0);
}

static void a_write_that_fails_leaves_the_old_file(void **state) {
    (void)state;
    folder f = make_folder();
    const char *path = inside(&f, "a");
    write_file(path, "old");
    struct rlimit before, tight;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    tight = before;
    tight.rlim_cur = 1000;
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
    hs_file file;
    hs_error err = {0};
    bool created = hs_file_create(&file, path, &err);
    for (int i = 0; created && i < 100000; i++)
        fputs("line\n", file.stream);
    bool committed = created && hs_file_commit(&file, &err);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, handler);
    assert_true(created);
    assert_false(committed);
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_non_null(strstr(err.text, path));
    assert_non_null(strstr(err.text, strerror(EFBIG)));
    assert_content(path, "old");
    assert_int_equal(count_entries(&f), 1);
    unlink(path);
    assert_int_equal(rmdir(f.path), 0);
}

/* A pipe in the test's own folder stands for all that is no regular file: were a device of the
 * machine used, code that fails this test would replace it. */
static void a_pipe_is_written_to_and_not_replaced(void **state) {
    (void)state;
    folder f = make_folder();
    const char *path = inside(&f, "pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    int reader = open(path, O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    write_file(path, "text");
    char text[10] = "";
    assert_int_equal(read(reader, text, sizeof text), 4);
    assert_string_equal(text, "text");

    hs_file file;
    hs_error err = {0};
    void (*handler)(int) = signal(SIGPIPE, SIG_IGN);
    assert_true(hs_file_create(&file, path, &err));
    fputs("text", file.stream);
    close(reader);
    bool committed = hs_file_commit(&file, &err);
    signal(SIGPIPE, handler);
    assert_false(committed);
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_non_null(strstr(err.text, inside(&f, "pipe: cannot write: ")));
    assert_non_null(strstr(err.text, strerror(EPIPE)));

    struct stat status;
    assert_int_equal(lstat(path, &status), 0);
    assert_true(S_ISFIFO(status.st_mode));
    assert_int_equal(count_entries(&f), 1);
    unlink(path);
    assert_int_equal(rmdir(f.path), 0);
}

static void files_that_cannot_be_opened_are_named(void **state) {
    (void)state;
    folder f = make_folder();
    hs_file file;
    hs_error err = {0};
    assert_false(hs_file_create(&file, inside(&f, "no/a"), &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_non_null(strstr(err.text, inside(&f, "no/a: cannot write: No such file")));
    assert_false(hs_file_create(&file, f.path, &err));
    assert_non_null(strstr(err.text, "directory; name a file"));
    assert_null(file.stream);

    uint8_t *bytes;
    size_t size;
    assert_false(hs_file_read(inside(&f, "a"), 10, &bytes, &size, &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_non_null(strstr(err.text, inside(&f, "a: cannot read: No such file")));
    assert_false(hs_file_read(f.path, 10, &bytes, &size, &err));
    assert_non_null(strstr(err.text, "directory"));
    assert_int_equal(rmdir(f.path), 0);
}

static void reading_stops_at_the_limit(void **state) {
    (void)state;
    folder f = make_folder();
    const char *path = inside(&f, "a");
    uint8_t *bytes;
    size_t size;
    hs_error err;
    static const size_t sizes[] = {0, 1, 65534, 65535, 65536, 65537, 200000};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        hs_file file;
        assert_true(hs_file_create(&file, path, &err));
        for (size_t b = 0; b < sizes[i]; b++)
            putc((int)(b % 251), file.stream);
        assert_true(hs_file_commit(&file, &err));
        assert_true(hs_file_read(path, sizes[i], &bytes, &size, &err));
        assert_int_equal(size, sizes[i]);
        for (size_t b = 0; b < size; b++)
            if (bytes[b] != b % 251) fail_msg("byte %zu of %zu", b, size);
        assert_int_equal(bytes[size], 0);
        free(bytes);
        if (sizes[i] == 0) continue;
        assert_false(hs_file_read(path, sizes[i] - 1, &bytes, &size, &err));
        assert_null(bytes);
        assert_non_null(strstr(err.text, "has more than"));
    }
    unlink(path);
    assert_int_equal(rmdir(f.path), 0);
}

static void a_zero_byte_in_a_text_is_named_by_its_line(void **state) {
    (void)state;
    hs_error err;
    assert_true(hs_text_check("", 0, "a", HS_EXIT_STREAM, &err));
    assert_true(hs_text_check("a\nb", 3, "a", HS_EXIT_STREAM, &err));
    assert_false(hs_text_check("a\nb\0c", 5, "a", HS_EXIT_STREAM, &err));
    assert_int_equal(err.code, HS_EXIT_STREAM);
    assert_non_null(strstr(err.text, "a:2: a zero byte"));
}

static void a_message_has_no_control_characters(void **state) {
    (void)state;
    hs_error err;
    hs_fail(&err, HS_EXIT_FILE, "%s: gr\u00f6\u00dfer", "a\033[2J\n\x7f");
    assert_string_equal(err.text, "a?[2J??: gr\u00f6\u00dfer");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_zero_byte_in_a_text_is_named_by_its_line),
        cmocka_unit_test(a_message_has_no_control_characters),
        cmocka_unit_test(a_file_appears_only_when_it_is_committed),
        cmocka_unit_test(a_process_that_ends_leaves_no_temporary_file),
        cmocka_unit_test(a_write_that_fails_leaves_the_old_file),
        cmocka_unit_test(a_pipe_is_written_to_and_not_replaced),
        cmocka_unit_test(files_that_cannot_be_opened_are_named),
        cmocka_unit_test(reading_stops_at_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
