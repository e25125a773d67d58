#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What `make install` puts in place serves a program that knows nothing of the source tree.
. "$(dirname "$0")/given.sh"
build=$2

check "it installs" cmake --install "$build" --prefix "$work/usr"
check "the program runs" "$work/usr/bin/crease" --version
check "the manual page is there" test -s "$work/usr/share/man/man1/crease.1"
cat >user.c <<'C'
#include <crease/crease.h>
#include <stdio.h>
int main(void)
{
    crease_context *context = NULL;
    crease_cloud *cloud = NULL;
    crease_sheet *sheet = NULL;
    if (crease_context_create(NULL, &context) != CREASE_OK ||
        crease_shape_sample(context, NULL, &cloud) != CREASE_OK ||
        crease_sheet_fit(context, cloud, NULL, &sheet) != CREASE_OK) {
        puts(crease_context_message(context));
        return 1;
    }
    printf("%zu crease, %.1f degrees\n", crease_sheet_line_count(sheet), crease_sheet_line(sheet, 0).angle);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return 0;
}
C
export PKG_CONFIG_PATH=$(dirname "$(find "$work/usr" -name crease.pc)")
# shellcheck disable=SC2046
check "a program builds by pkg-config" cc user.c -o user $(pkg-config --cflags --libs --static crease)
check "and finds the crease" sh -c './user | grep "1 crease, 90.0 degrees"'
finish
