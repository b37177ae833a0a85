#include "renderer/base/filter.h"
