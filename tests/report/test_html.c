/* SPDX-License-Identifier: MIT
 *
 * The report: escapes, the choice of images within a budget, what it says where something is
 * missing. What a browser makes of it is tested in tests/web/.
 */
#include "core/base/fs.h"
#include "core/report/html.h"
#include "core/report/html_images.h"
#include "core/report/html_text.h"
#include "tests/report/trials.h"

#include <unistd.h>

enum { FRAMES = 8, BYTES = 3000 /* of an image: 4000 as text */ };

static char folder[] = "/tmp/irb_html_XXXXXX";
static const char *const trials[] = {"rsm", "rsm:samples=9", "ism", "ism:vpls=4"};
static const double flips[] = {0.5, 0.25, 0.125, 0.75};

/* ---- a run that nobody rendered */

static void write_image(const char *sub, const char *stem, int frame)
{
    struct irb_error err = {0};
    char bytes[BYTES];
    memset(bytes, 'x', sizeof bytes);
    char *dir = irb_asprintf("%s/%s", folder, sub);
    char *path = irb_asprintf("%s/%s-%04d.jpg", dir, stem, frame);
    REQUIRE_OK(irb_fs_make_dirs(dir, &err));
    REQUIRE_OK(irb_fs_write(path, bytes, sizeof bytes, &err));
    free(path);
    free(dir);
}

/* The worst frame of trial t is 2 t + 1. */
static void add_trial(struct irb_store *store, int t)
{
    const char *colon = strchr(trials[t], ':');
    size_t length = colon ? (size_t)(colon - trials[t]) : strlen(trials[t]);
    char *method = strndup(trials[t], length), *sub = irb_asprintf("box/%s/film", trials[t]);
    int64_t id = trials_add(store, "box", method, trials[t], "{}", 1);
    trials_score(store, id, -1, "indirect_flip", flips[t]);
    for (int f = 0; f < FRAMES; f++) {
        trials_score(store, id, f, "indirect_flip", f == 2 * t + 1 ? 1 : flips[t]);
        trials_time(store, id, f, 2 + t);
        write_image(sub, "indirect", f);
        write_image(sub, "flip", f);
        if (f) /* the change since the frame before */
            write_image(sub, "residual", f);
    }
    free(sub);
    free(method);
}

static int set_up(void **state)
{
    struct irb_store *store = trials_open(folder);
    for (int t = 0; t < 4; t++)
        add_trial(store, t);
    for (int f = 0; f < FRAMES; f++)
        write_image("box/film", "reference", f);
    /* a scene that only a page has */
    int64_t id = trials_add(store, "b</script><b>&\"'", "x<y", "x<y:z=\"&'", "{}", 1);
    trials_score(store, id, -1, "indirect_flip", 0.5);
    trials_time(store, id, 0, 4);
    struct irb_error err = {0};
    REQUIRE_OK(irb_store_set_meta(store, "config_name", "<i>name</i>", &err));
    REQUIRE_OK(irb_store_set_meta(store, "config_text", "a: </pre></script><b>\n", &err));
    *state = store;
    return 0;
}

static int tear_down(void **state)
{
    return trials_close(*state, folder);
}

/* ---- text */

static void expect_text(void (*escape)(struct irb_str *, const char *), const char *text,
                        const char *expected)
{
    struct irb_str out = {0};
    escape(&out, text);
    assert_string_equal(irb_str_text(&out), expected);
    irb_str_free(&out);
}

static void test_text(void **state)
{
    (void)state;
    expect_text(irb_html_text, "a<b>&\"c\"'d'", "a&#x3c;b&#x3e;&#x26;&#x22;c&#x22;&#x27;d&#x27;");
    expect_text(irb_html_text, "\x01\t\n\x7f\xc3\xa9", "&#xfffd;\t\n&#xfffd;&#xe9;");
    expect_text(irb_html_markup, "<b>\xe2\x82\xac & \xf0\x9f\x98\x80</b>",
                "<b>&#x20ac; & &#x1f600;</b>");
    expect_text(irb_html_json, "\"\xe2\x82\xac\xf0\x9f\x98\x80\"", "\"\\u20ac\\ud83d\\ude00\"");
    /* a byte of no character, one that is cut short, an overlong slash, a surrogate, too large */
    expect_text(irb_html_markup, "\xff.\xe2\x82.\xc0\xaf.\xed\xa0\x80.\xf4\x90\x80\x80",
                "&#xfffd;.&#xfffd;&#xfffd;.&#xfffd;&#xfffd;.&#xfffd;&#xfffd;&#xfffd;."
                "&#xfffd;&#xfffd;&#xfffd;&#xfffd;");
    expect_text(irb_html_json, "[\"</script><!--\"]", "[\"\\u003c/script>\\u003c!--\"]");
}

/* RFC 4648, section 10 */
static void test_base64(void **state)
{
    (void)state;
    static const char *const vectors[][2] = {{"", ""},
                                             {"f", "Zg=="},
                                             {"fo", "Zm8="},
                                             {"foo", "Zm9v"},
                                             {"foob", "Zm9vYg=="},
                                             {"fooba", "Zm9vYmE="},
                                             {"foobar", "Zm9vYmFy"},
                                             {"\xff\xfe\xfd", "//79"}};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        struct irb_str out = {0};
        size_t length = strlen(vectors[i][0]);
        irb_html_base64(&out, vectors[i][0], length);
        assert_string_equal(irb_str_text(&out), vectors[i][1]);
        assert_int_equal(irb_html_base64_length(length), out.length);
        irb_str_free(&out);
    }
}

/* ---- images within a budget */

/* What a choice came to. */
struct chosen {
    bool wanted[4];
    int frames; /* bits */
    size_t bytes;
    char notes[4096];
};

static struct chosen choose(struct irb_store *store, double budget, const char *asked)
{
    struct irb_error err = {0};
    struct irb_analysis analysis;
    struct irb_html_images images;
    const struct irb_html_options options = {.trials = &asked, .trial_count = asked ? 1 : 0};
    REQUIRE_OK(irb_analysis_read(&analysis, store, IRB_CONFIDENCE, &err));
    REQUIRE_OK(irb_html_images_find(&images, folder, &analysis, &options, &err));
    irb_html_images_choose(&images, &analysis, budget, NULL);
    struct chosen out = {0};
    for (int t = 0; t < 4; t++)
        out.wanted[t] = images.scenes[0].trials[t].wanted;
    for (int f = 0; f < FRAMES; f++)
        out.frames |= images.scenes[0].frames[f] << f;
    snprintf(out.notes, sizeof out.notes, "%s", irb_str_text(&images.notes));
    char *text = NULL;
    FILE *memory = open_memstream(&text, &out.bytes);
    REQUIRE_OK(irb_html_images_write(memory, &images, &err));
    fclose(memory);
    free(text);
    irb_html_images_destroy(&images);
    irb_analysis_destroy(&analysis);
    return out;
}

static void expect_wanted(const struct chosen *chosen, int bits)
{
    for (int t = 0; t < 4; t++)
        if (chosen->wanted[t] != (bits >> t & 1))
            fail_msg("trial %s: %s", trials[t], chosen->wanted[t] ? "wanted" : "not wanted");
}

static void test_choice(void **state)
{
    const double image = 4003, strip = FRAMES * image; /* text and quotes */
    const double trial = 3 * strip - image;            /* residuals begin with frame 1 */
    struct chosen all = choose(*state, strip + 4 * trial, NULL);
    expect_wanted(&all, 0xf);
    assert_int_equal(all.frames, 0xff);
    assert_null(strstr(all.notes, "left out"));
    /* the best of each method, and who is asked for */
    struct chosen best = choose(*state, strip + 4 * trial - 1, NULL);
    expect_wanted(&best, 0x6);
    assert_int_equal(best.frames, 0xff);
    assert_non_null(strstr(best.notes, "2 trials are left out"));
    assert_non_null(strstr(best.notes, "box rsm, box ism:vpls=4"));
    struct chosen asked = choose(*state, strip + 3 * trial, "ism:vpls=4");
    expect_wanted(&asked, 0xe);
    assert_int_equal(asked.frames, 0xff);
    assert_null(strstr(asked.notes, "residual"));
    struct chosen without = choose(*state, 5 * strip, NULL);
    expect_wanted(&without, 0x6);
    assert_int_equal(without.frames, 0xff);
    assert_non_null(strstr(without.notes, "residual are left out"));
    /* every second frame and the worst ones, 3 of rsm:samples=9 and 5 of ism */
    struct chosen half = choose(*state, 5 * 6 * image, NULL);
    expect_wanted(&half, 0x6);
    assert_int_equal(half.frames, 0x7d);
    assert_non_null(strstr(half.notes, "one frame in 2"));
    /* the worse one goes first: of rsm:samples=9, ism stays with its worst frame and frame 0 */
    struct chosen one = choose(*state, 3 * 2 * image, NULL);
    expect_wanted(&one, 0x4);
    assert_int_equal(one.frames, 0x21);
    struct chosen none = choose(*state, 0, NULL);
    expect_wanted(&none, 0);
    assert_int_equal(none.bytes, 0);
}

/* Whatever the budget, the file keeps it. */
static void test_budget(void **state)
{
    const size_t element = 80; /* "<script ...></script>" of a strip */
    for (double budget = 0; budget < 14 * FRAMES * 4003; budget += 1777) {
        struct chosen chosen = choose(*state, budget, NULL);
        if ((double)chosen.bytes > budget + 13 * element)
            fail_msg("budget %g: %zu bytes", budget, chosen.bytes);
    }
}

/* ---- the page */

static bool write_report(const char *run, const char *path, const char *trial,
                         struct irb_error *err)
{
    const struct irb_html_options options = {.trials = &trial,
                                             .trial_count = trial ? 1 : 0,
                                             .max_mb = IRB_HTML_MAX_MB,
                                             .version = "1 <&>"};
    return irb_html_write(run, path, &options, err);
}

/* malloc'ed */
static char *read_report(void)
{
    struct irb_error err = {0};
    char *path = irb_asprintf("%s/report.html", folder), *text = NULL;
    REQUIRE_OK(write_report(folder, path, NULL, &err));
    REQUIRE_OK(irb_fs_read(path, 1 << 26, &text, NULL, &err));
    free(path);
    return text;
}

static int count(const char *text, const char *word)
{
    int n = 0;
    for (; (text = strstr(text, word)); text += strlen(word))
        n++;
    return n;
}

static void test_page(void **state)
{
    (void)state;
    char *text = read_report();
    assert_non_null(strstr(text, "<title>&#x3c;i&#x3e;name&#x3c;/i&#x3e; "));
    assert_non_null(strstr(text, "b&#x3c;/script&#x3e;&#x3c;b&#x3e;&#x26;&#x22;&#x27;"));
    assert_non_null(strstr(text, "\"x\\u003cy:z=\\\"&'\""));
    assert_non_null(
        strstr(text, "<pre>a: &#x3c;/pre&#x3e;&#x3c;/script&#x3e;&#x3c;b&#x3e;\n</pre>"));
    for (const char *c = text; *c; c++)
        if ((unsigned char)*c >= 0x80)
            fail_msg("not ASCII: %.40s", c);
    assert_null(strstr(text, "<i>"));
    assert_null(strstr(text, "</script><b>"));
    assert_null(strstr(text, "{{"));
    assert_int_equal(count(text, "<script"), count(text, "</script>"));
    /* thirteen strips, the run and the page's own script */
    assert_int_equal(count(text, "<script"), 13 + 2);
    char *again = read_report();
    assert_string_equal(text, again);
    free(again);
    free(text);
}

static void test_without_gnuplot(void **state)
{
    (void)state;
    char *path = irb_strdup(getenv("PATH"));
    setenv("PATH", "/nonexistent", 1);
    char *text = read_report();
    setenv("PATH", path, 1);
    assert_non_null(strstr(text, "Not drawn"));
    assert_non_null(strstr(text, "download=\"pareto.csv\""));
    assert_null(strstr(text, "<svg"));
    free(text);
    free(path);
}

static void expect_error(const char *run, const char *path, const char *trial,
                         enum irb_error_code code, const char *words)
{
    struct irb_error err = {0};
    assert_false(write_report(run, path, trial, &err));
    assert_int_equal(err.code, code);
    if (!strstr(err.message, words))
        fail_msg("%s", err.message);
}

static void test_errors(void **state)
{
    (void)state;
    char *path = irb_asprintf("%s/no/such/folder/report.html", folder);
    expect_error("/nonexistent", path, NULL, IRB_E_INPUT, "/nonexistent");
    expect_error(folder, path, NULL, IRB_E_IO, "no/such/folder");
    expect_error(folder, path, "rsm:samples=8", IRB_E_INPUT, "did you mean 'rsm:samples=9'");
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text),   cmocka_unit_test(test_base64),
        cmocka_unit_test(test_choice), cmocka_unit_test(test_budget),
        cmocka_unit_test(test_page),   cmocka_unit_test(test_without_gnuplot),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
