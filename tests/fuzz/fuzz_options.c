/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The option parser, on any words: lines are arguments, the first byte chooses the command. */
#include "option.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_WORDS = 64 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1)
        return 0;
    char *text = malloc(size + 1), *words[MOST_WORDS + 1], *rest = text;
    if (!text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    const int bit = 1 << (data[0] % 7);
    int count = 0;
    for (rest++; count < MOST_WORDS && rest < text + size; count++) {
        words[count] = rest;
        rest += strcspn(rest, "\n");
        *rest++ = '\0';
    }
    words[count] = NULL;
    settings s = settings_default();
    if (options_parse(bit, "fuzz", count, words, &s)) {
        char value[512];
        for (size_t i = 0; i < option_count; i++)
            if (option_table[i].commands & bit)
                option_value_text(&option_table[i], &s, value, sizeof value);
    }
    free(text);
    return 0;
}
