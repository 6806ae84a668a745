FROM debian:12 AS build
WORKDIR /fathom
COPY scripts/install-packages scripts/
RUN scripts/install-packages --package
COPY . .
RUN scripts/package

FROM debian:12-slim
COPY --from=build /fathom/build/package/*.deb /packages/
RUN apt-get update \
 && apt-get install --yes --no-install-recommends /packages/fathom_*.deb /packages/fathom-data_*.deb /packages/libfathom-openni2_*.deb gnuplot-nox libjs-three fonts-dejavu-core \
 && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["fathom"]
