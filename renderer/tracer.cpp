#include "renderer/tracer.h"
