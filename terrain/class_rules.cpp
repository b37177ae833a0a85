#include "terrain/class_rules.h"
