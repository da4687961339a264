/* Must not compile: another vendor's hl.h has been included, as its guard says. */
#define HL_H_DEFINE
#include <hl/hl.h>

int unused;
