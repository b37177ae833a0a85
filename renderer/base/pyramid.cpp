#include "renderer/base/pyramid.h"
