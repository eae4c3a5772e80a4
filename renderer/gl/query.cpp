#include "renderer/gl/query.h"

#include <glad/gl.h>

namespace lightsweep::gl {

void detail::delete_query(unsigned id) { glDeleteQueries(1, &id); }

namespace {

unsigned create(GLenum target) {
    unsigned id = 0;
    glCreateQueries(target, 1, &id);
    return id;
}

uint64_t wait(unsigned id) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(id, GL_QUERY_RESULT, &value);
    return value;
}

}  // namespace

TimestampQuery::TimestampQuery() : handle_(create(GL_TIMESTAMP)) {}
void TimestampQuery::record() const { glQueryCounter(handle_.id(), GL_TIMESTAMP); }
uint64_t TimestampQuery::wait_ns() const { return wait(handle_.id()); }

ElapsedQuery::ElapsedQuery() : handle_(create(GL_TIME_ELAPSED)) {}
void ElapsedQuery::begin() const { glBeginQuery(GL_TIME_ELAPSED, handle_.id()); }
void ElapsedQuery::end() const { glEndQuery(GL_TIME_ELAPSED); }
uint64_t ElapsedQuery::wait_ns() const { return wait(handle_.id()); }

SamplesQuery::SamplesQuery() : handle_(create(GL_SAMPLES_PASSED)) {}
void SamplesQuery::begin() const { glBeginQuery(GL_SAMPLES_PASSED, handle_.id()); }
void SamplesQuery::end() const { glEndQuery(GL_SAMPLES_PASSED); }
uint64_t SamplesQuery::wait_count() const { return wait(handle_.id()); }

}  // namespace lightsweep::gl
