#include "renderer/base/error.h"
