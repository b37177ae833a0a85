#include "renderer/guidance.h"
