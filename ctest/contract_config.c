/* The rules of the interface, for configs. */
#include "scene.h"

static void making(void) {
    gt2_config *const untouched = (gt2_config *)(void *)&check_failures;
    gt2_config *config = untouched;
    CHECK_STATUS(gt2_config_new(NULL, &config), GT2_ERR_NULL_POINTER);
    CHECK_MESSAGE("algorithm is NULL");
    CHECK_STATUS(gt2_config_new("magic", &config), GT2_ERR_UNKNOWN_ALGORITHM);
    CHECK_MESSAGE("\"magic\"");
    CHECK_MESSAGE("gentrack2");
    CHECK_STATUS(gt2_config_new("", &config), GT2_ERR_UNKNOWN_ALGORITHM);
    CHECK_STATUS(gt2_config_new("gentrack\xff", &config), GT2_ERR_INVALID_TEXT);
    CHECK(config == untouched); /* outputs are written on success only */
    CHECK_STATUS(gt2_config_new("gentrack2", NULL), GT2_ERR_NULL_POINTER);
    CHECK_MESSAGE("out is NULL");
    gt2_config_free(NULL);

    CHECK(gt2_algorithm_count() >= 1);
    for (size_t i = 0; i < gt2_algorithm_count(); i++) {
        CHECK_OK(gt2_config_new(gt2_algorithm_name(i), &config));
        CHECK(strcmp(gt2_config_algorithm(config), gt2_algorithm_name(i)) == 0);
        CHECK(strlen(gt2_algorithm_description(i)) > 10);
        gt2_tracker *tracker = NULL;
        CHECK_OK(gt2_tracker_new(config, &tracker));
        CHECK(strcmp(gt2_tracker_algorithm(tracker), gt2_algorithm_name(i)) == 0);
        gt2_tracker_free(tracker);
        gt2_config_free(config);
    }
    CHECK(gt2_algorithm_name(gt2_algorithm_count()) == NULL);
    CHECK(gt2_algorithm_description((size_t)-1) == NULL);
    CHECK_MESSAGE("index: is ");
}

/* Pointers that are no config are told apart where that is possible. */
static void foreign_handles(void) {
    static const uint64_t zeros[64];
    const gt2_config *none = (const gt2_config *)(const void *)zeros;
    const gt2_config *odd = (const gt2_config *)(const void *)((const char *)zeros + 1);
    gt2_tracker *tracker = new_tracker();
    const gt2_config *other = (const gt2_config *)(const void *)tracker;
    double number = 0.0;
    CHECK_STATUS(gt2_config_get_number(NULL, "seed", &number), GT2_ERR_NULL_POINTER);
    CHECK_MESSAGE("config is NULL");
    CHECK_STATUS(gt2_config_get_number(none, "seed", &number), GT2_ERR_INVALID_HANDLE);
    CHECK_STATUS(gt2_config_get_number(odd, "seed", &number), GT2_ERR_INVALID_HANDLE);
    CHECK_STATUS(gt2_config_get_number(other, "seed", &number), GT2_ERR_INVALID_HANDLE);
    CHECK_MESSAGE("config is not a live gt2_config");
    CHECK(gt2_config_algorithm(other) == NULL && gt2_config_algorithm(NULL) == NULL);
    CHECK(gt2_config_parameter_count(NULL) == 0 && gt2_config_preset_count(other) == 0);
    CHECK(gt2_config_preset_name(NULL, 0) == NULL);
    gt2_config_free((gt2_config *)(void *)tracker); /* not a config: nothing happens */
    CHECK(strcmp(gt2_tracker_algorithm(tracker), "gentrack2") == 0);
    gt2_tracker_free(tracker);
}

static void setting(void) {
    gt2_config *config = new_config();
    double number = -1.0;
    int64_t integer = -1;
    CHECK_OK(gt2_config_set(config, "particles", "12"));
    CHECK_OK(gt2_config_get_integer(config, "particles", &integer));
    CHECK(integer == 12);
    CHECK_OK(gt2_config_set_integer(config, "particles", 13));
    CHECK_OK(gt2_config_set_number(config, "particles", 14.0));
    CHECK_OK(gt2_config_get_number(config, "particles", &number));
    CHECK(fabs(number - 14.0) == 0.0);
    CHECK_OK(gt2_config_set_number(config, "lambda_p", 0.125));
    CHECK_OK(gt2_config_get_number(config, "lambda_p", &number));
    CHECK(fabs(number - 0.125) == 0.0);
    CHECK_OK(gt2_config_set_boolean(config, "antithetic", 0));
    CHECK_OK(gt2_config_get_integer(config, "antithetic", &integer));
    CHECK(integer == 0);
    CHECK_OK(gt2_config_set_integer(config, "seed", INT64_MAX));
    CHECK_OK(gt2_config_get_integer(config, "seed", &integer));
    CHECK(integer == INT64_MAX);

    /* Refusals name the parameter and the range, and change nothing. */
    CHECK_STATUS(gt2_config_set(config, "particles", "0"), GT2_ERR_PARAMETER_VALUE);
    CHECK_MESSAGE("particles");
    CHECK_MESSAGE("1..=256");
    CHECK_STATUS(gt2_config_set_integer(config, "particles", 257), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_set_number(config, "particles", 2.5), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_set_number(config, "lambda_p", NAN), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_set_number(config, "lambda_p", INFINITY), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_set(config, "lambda_p", "nan"), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_set(config, "lambda_p", ""), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_set_boolean(config, "antithetic", 2), GT2_ERR_INVALID_ARGUMENT);
    CHECK_STATUS(gt2_config_set_boolean(config, "lambda_p", 1), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_set(config, "resampling", "sometimes"), GT2_ERR_PARAMETER_VALUE);
    CHECK_MESSAGE("discard");
    CHECK_STATUS(gt2_config_set(config, "particels", "1"), GT2_ERR_UNKNOWN_PARAMETER);
    CHECK_MESSAGE("\"particels\"");
    CHECK_STATUS(gt2_config_set(config, NULL, "1"), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_config_set(config, "particles", NULL), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_config_set(config, "particles\xc3", "1"), GT2_ERR_INVALID_TEXT);
    CHECK_STATUS(gt2_config_get_number(config, "resampling", &number), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_get_integer(config, "lambda_p", &integer), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_get_number(config, "lambda_p", NULL), GT2_ERR_NULL_POINTER);
    CHECK_OK(gt2_config_get_integer(config, "particles", &integer));
    CHECK_OK(gt2_config_get_number(config, "lambda_p", &number));
    CHECK(integer == 14 && fabs(number - 0.125) == 0.0);

    /* Values that contradict each other are refused when a tracker is made. */
    gt2_tracker *tracker = NULL;
    CHECK_OK(gt2_config_set(config, "history", "5"));
    CHECK_OK(gt2_config_set(config, "regression_window", "6"));
    CHECK_STATUS(gt2_tracker_new(config, &tracker), GT2_ERR_PARAMETER_VALUE);
    CHECK_MESSAGE("regression_window");
    CHECK(tracker == NULL);
    gt2_config_free(config);
}

static void text_buffers(void) {
    gt2_config *config = new_config();
    char buffer[8] = "keep";
    size_t needed = 99;
    CHECK_OK(gt2_config_set(config, "resampling", "discard"));
    CHECK_OK(gt2_config_get(config, "resampling", NULL, 0, &needed));
    CHECK(needed == 8); /* "discard" and its NUL */
    needed = 99;
    CHECK_STATUS(gt2_config_get(config, "resampling", buffer, 7, &needed), GT2_ERR_BUFFER_TOO_SMALL);
    CHECK_MESSAGE("8 bytes are needed");
    CHECK(needed == 8 && strcmp(buffer, "keep") == 0);
    CHECK_OK(gt2_config_get(config, "resampling", buffer, 8, NULL));
    CHECK(strcmp(buffer, "discard") == 0);
    CHECK_STATUS(gt2_config_get(config, "resampling", NULL, 8, &needed), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_config_get(config, "resampling", NULL, 0, NULL), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_config_get(config, "nothing", buffer, 8, NULL), GT2_ERR_UNKNOWN_PARAMETER);
    gt2_config_free(config);
}

static char *toml_of(const gt2_config *config) {
    size_t needed = 0;
    CHECK_OK(gt2_config_to_toml(config, NULL, 0, &needed));
    char *text = (char *)calloc(needed, 1);
    CHECK_OK(gt2_config_to_toml(config, text, needed, NULL));
    CHECK(strlen(text) + 1 == needed);
    return text;
}

static void toml(void) {
    gt2_config *config = new_config(), *copy = NULL, *read = new_config();
    CHECK_OK(gt2_config_set(config, "preset", "paper"));
    CHECK_OK(gt2_config_set(config, "particles", "12"));
    CHECK_OK(gt2_config_set(config, "entrance_areas", "0,0,10.5,20;5,6,7,8"));
    CHECK_OK(gt2_config_clone(config, &copy));
    char *text = toml_of(config), *text_of_copy = toml_of(copy);
    CHECK(strcmp(text, text_of_copy) == 0);
    CHECK_OK(gt2_config_load_toml(read, text, strlen(text)));
    char *text_again = toml_of(read);
    CHECK(strcmp(text, text_again) == 0);

    /* The clone is a config of its own. */
    int64_t particles = 0;
    CHECK_OK(gt2_config_set(copy, "particles", "3"));
    CHECK_OK(gt2_config_get_integer(config, "particles", &particles));
    CHECK(particles == 12);
    CHECK_STATUS(gt2_config_clone(NULL, &copy), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_config_clone(config, NULL), GT2_ERR_NULL_POINTER);

    /* The length counts, not a NUL; a bad text changes nothing. */
    const char *lines = "particles = 20\nparticles = ";
    CHECK_OK(gt2_config_load_toml(read, lines, strlen("particles = 20")));
    CHECK_STATUS(gt2_config_load_toml(read, "particles = 30\nnonsense", 23), GT2_ERR_CONFIG_SYNTAX);
    CHECK_MESSAGE("line 2");
    CHECK_STATUS(gt2_config_load_toml(read, "particles = 0", 13), GT2_ERR_PARAMETER_VALUE);
    CHECK_STATUS(gt2_config_load_toml(read, "no_such = 0", 11), GT2_ERR_UNKNOWN_PARAMETER);
    CHECK_STATUS(gt2_config_load_toml(read, "algorithm = \"x\"", 15), GT2_ERR_UNKNOWN_ALGORITHM);
    CHECK_STATUS(gt2_config_load_toml(read, "\xff", 1), GT2_ERR_INVALID_TEXT);
    CHECK_STATUS(gt2_config_load_toml(read, NULL, 1), GT2_ERR_NULL_POINTER);
    CHECK_OK(gt2_config_load_toml(read, NULL, 0));
    CHECK_OK(gt2_config_get_integer(read, "particles", &particles));
    CHECK(particles == 20);

    free(text);
    free(text_of_copy);
    free(text_again);
    gt2_config_free(config);
    gt2_config_free(copy);
    gt2_config_free(read);
}

/* Every parameter describes itself, and its default is what a new config has and what can be set. */
static void introspection(void) {
    gt2_config *config = new_config();
    const size_t count = gt2_config_parameter_count(config);
    CHECK(count > 20);
    for (size_t i = 0; i < count; i++) {
        gt2_parameter_info info = GT2_PARAMETER_INFO_INIT;
        char value[256] = "";
        CHECK_OK(gt2_config_parameter_info(config, i, &info));
        CHECK(strlen(info.key) > 0 && strlen(info.documentation) > 0);
        CHECK(info.unit != NULL && info.symbol != NULL && info.reserved == 0);
        CHECK_OK(gt2_config_get(config, info.key, value, sizeof value, NULL));
        CHECK(strcmp(value, info.default_text) == 0);
        CHECK_OK(gt2_config_set(config, info.key, info.default_text));
        for (size_t k = 0; k < info.choice_count; k++) {
            CHECK_OK(gt2_config_set(config, info.key, info.choices[k]));
        }
        if (info.kind == GT2_PARAMETER_NUMBER) {
            CHECK_OK(gt2_config_set_number(config, info.key, info.minimum));
            CHECK_OK(gt2_config_set_number(config, info.key, info.maximum));
            CHECK_STATUS(gt2_config_set_number(config, info.key, info.minimum - 1.0), GT2_ERR_PARAMETER_VALUE);
            CHECK_STATUS(gt2_config_set_number(config, info.key, info.maximum * 1.5), GT2_ERR_PARAMETER_VALUE);
        }
    }
    gt2_parameter_info info = GT2_PARAMETER_INFO_INIT;
    CHECK_STATUS(gt2_config_parameter_info(config, count, &info), GT2_ERR_INVALID_ARGUMENT);
    CHECK(info.key == NULL);
    CHECK_STATUS(gt2_config_parameter_info(config, 0, NULL), GT2_ERR_NULL_POINTER);
    /* An older program's shorter struct gets what it has room for. */
    info.struct_size = offsetof(gt2_parameter_info, kind);
    CHECK_OK(gt2_config_parameter_info(config, 0, &info));
    CHECK(info.key != NULL && info.kind == 0 && info.documentation == NULL);
    info.struct_size = 3;
    CHECK_STATUS(gt2_config_parameter_info(config, 0, &info), GT2_ERR_STRUCT_SIZE);

    CHECK(gt2_config_preset_count(config) >= 1);
    for (size_t i = 0; i < gt2_config_preset_count(config); i++) {
        CHECK_OK(gt2_config_set(config, "preset", gt2_config_preset_name(config, i)));
    }
    CHECK(gt2_config_preset_name(config, gt2_config_preset_count(config)) == NULL);
    CHECK_STATUS(gt2_config_set(config, "preset", "none of them"), GT2_ERR_PARAMETER_VALUE);
    gt2_config_free(config);
}

int main(void) {
    making();
    foreign_handles();
    setting();
    text_buffers();
    toml();
    introspection();
    return check_result();
}
