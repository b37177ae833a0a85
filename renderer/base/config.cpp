#include "renderer/base/config.h"
