# SPDX-License-Identifier: BSD-3-Clause
# docker build -t pcl6d . && docker run --rm -v "$PWD:/data" pcl6d pcl_slam6d /data/SCANS -o /data/OUT
# The first stage runs the two commands of the README and makes the packages; the second one has
# the programs and the Python package alone. Not run here: this machine has no Docker.
FROM debian:bookworm AS build
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates git
COPY . /src
WORKDIR /src
RUN share/demo.sh
RUN test/run.sh
RUN apt-get install -y --no-install-recommends chrpath debhelper dh-python && \
    cmake --build build/release --target deb

FROM debian:bookworm-slim
COPY --from=build /src/build/release/deb/*.deb /tmp/
RUN apt-get update && \
    apt-get install -y --no-install-recommends /tmp/libpcl6d0.1_*.deb /tmp/pcl6d-tools_*.deb \
      /tmp/python3-pcl6d_*.deb xvfb libgl1-mesa-dri && \
    rm -rf /tmp/*.deb /var/lib/apt/lists/*
CMD ["pcl_slam6d"]
