/* The parameters of every tracker can be listed and set to their defaults. */
#include <stdio.h>

#include <gentrack2.h>

int main(void) {
    size_t parameters = 0, set = 0;
    for (size_t i = 0; i < gt2_algorithm_count(); i++) {
        gt2_config *config = NULL;
        if (gt2_config_new(gt2_algorithm_name(i), &config) != GT2_OK) {
            return 1;
        }
        for (size_t k = 0; k < gt2_config_parameter_count(config); k++) {
            gt2_parameter_info info = GT2_PARAMETER_INFO_INIT;
            parameters++;
            set += gt2_config_parameter_info(config, k, &info) == GT2_OK &&
                   gt2_config_set(config, info.key, info.default_text) == GT2_OK;
        }
        gt2_config_free(config);
    }
    printf("gentrack2 %s from Meson: %u of %u parameters set\n", gt2_version(), (unsigned)set, (unsigned)parameters);
    return parameters == 0 || set != parameters;
}
