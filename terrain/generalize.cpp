#include "terrain/generalize.h"
