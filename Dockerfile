# coordreq where there is no Debian 12; see docs/how-to/installing.md.
#   docker build -t coordreq .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/data" coordreq analyze spec.json
FROM debian:12
COPY . /coordreq
RUN cd /coordreq && scripts/setup build draw && cmake --preset release -Wno-dev && cmake --build --preset release \
 && cmake --install build/release --prefix /usr/local && rm -rf build /var/lib/apt/lists/*
WORKDIR /data
ENTRYPOINT ["coordreq"]
