// All that is said to and by mapobjects_store. Thread: plain values.
#pragma once

#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/delivery.hpp"
#include "messages/mapobjects_store/load.hpp"
#include "messages/mapobjects_store/object.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/mapobjects_store/operator_verdict.hpp"
#include "messages/mapobjects_store/pass.hpp"
#include "messages/mapobjects_store/scope.hpp"
#include "messages/mapobjects_store/shown.hpp"
#include "messages/mapobjects_store/status.hpp"
#include "messages/mapobjects_store/sync_state.hpp"
#include "messages/mapobjects_store/wake.hpp"
