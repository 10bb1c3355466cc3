package roomwise.spy;

/** Decodes PDZ16 depth images; common/image/depth_model.h says what the bytes mean. */
final class DepthDecoder {
    private static final int CONTEXTS = 48;
    private static final int LANES = 4;
    private static final int TOTAL_BITS = 10;
    private static final int TOTAL = 1 << TOTAL_BITS;
    private static final int STATE_MIN = 1 << 15;
    private static final int DIRECT = 16;
    private static final int LEFT_HOLE = 3;

    private final byte[] bytes;
    private int next;
    private final int[] valueOf = new int[1 << 16];
    private final int[][] frequency = new int[CONTEXTS][32];
    private final int[][] start = new int[CONTEXTS][32];
    private final byte[][] tokenAt = new byte[CONTEXTS][TOTAL];
    private int state;
    private int laneNext;

    private DepthDecoder(byte[] bytes) {
        this.bytes = bytes;
    }

    /** Depth steps row by row, 0 where there is no reading; throws RuntimeException on other bytes. */
    static int[] decode(byte[] bytes, int width, int height) {
        DepthDecoder decoder = new DepthDecoder(bytes);
        int[] values = new int[width * height];
        if (bytes[0] != 'P' || bytes[1] != 'Z' || bytes[2] != 1 || decoder.u16(4) != width
                || decoder.u16(6) != height) {
            throw new IllegalArgumentException("not a PDZ16 image of this size");
        }
        decoder.next = 8;
        if (bytes[3] == 0) {
            for (int i = 0; i < values.length; i++) values[i] = decoder.u16(8 + 2 * i);
        } else {
            decoder.readPalette(bytes[3] == 2);
            for (int context = 0; context < CONTEXTS; context++) decoder.readTable(context);
            decoder.decodeLanes(width, height, values);
        }
        return values;
    }

    private int u16(int at) {
        return bytes[at] & 0xff | (bytes[at + 1] & 0xff) << 8;
    }

    private int varint() {
        int value = 0;
        for (int shift = 0; ; shift += 7) {
            int b = bytes[next++];
            value |= (b & 0x7f) << shift;
            if (b >= 0) return value;
        }
    }

    private void readPalette(boolean hasPalette) {
        if (!hasPalette) {
            for (int i = 0; i < valueOf.length; i++) valueOf[i] = i;
            return;
        }
        int count = varint();
        for (int i = 1, value = 0; i <= count; i++) valueOf[i] = value += varint();
    }

    private void readTable(int context) {
        int used = varint();
        for (int token = 0, place = 0; token < used; token++) {
            frequency[context][token] = varint();
            start[context][token] = place;
            for (int end = place + frequency[context][token]; place < end; place++) {
                tokenAt[context][place] = (byte) token;
            }
        }
    }

    private void decodeLanes(int width, int height, int[] values) {
        int[] words = new int[LANES];
        for (int lane = 0; lane < LANES; lane++) words[lane] = varint();
        int row = 0;
        for (int lane = 0; lane < LANES; lane++) {
            int rows = height / LANES + (lane < height % LANES ? 1 : 0);
            laneNext = next;
            state = word() << 16;
            state |= word();
            decodeBand(width, row, rows, values);
            row += rows;
            next += 2 * words[lane];
        }
    }

    private void decodeBand(int width, int firstRow, int rows, int[] values) {
        int[] above = new int[width + 1];  // [0]: the margin left of the row
        int[] row = new int[width + 1];
        int[] classes = new int[width];
        java.util.Arrays.fill(classes, aboveClass(0, 0, 0, true, true));
        for (int v = firstRow; v < firstRow + rows; v++) {
            decodeRow(width, above, row, classes, values, v * width);
            for (int u = 0; u < width; u++) {
                int right = Math.min(u + 1, width - 1);
                classes[u] = aboveClass(row[u], row[u + 1], row[right + 1],
                        values[v * width + u] == 0, values[v * width + right] == 0);
            }
            int[] spare = above;
            above = row;
            row = spare;
        }
    }

    private void decodeRow(int width, int[] above, int[] row, int[] classes, int[] values, int out) {
        int left = row[0] = above[1];
        int holeClass = 0;
        for (int u = 0; u < width; u++) {
            int context = classes[u] + (order(left, above[u]) | holeClass);
            int token = take(context);
            holeClass = token == 0 ? LEFT_HOLE : 0;
            if (token > 0) {
                int folded = token <= DIRECT ? token - 1 : takeLarge(token - DIRECT + 3);
                int residual = folded >> 1 ^ -(folded & 1);
                left = predict(left, above[u + 1], above[u]) + residual & 0xffff;
            }
            row[u + 1] = left;
            values[out + u] = token == 0 ? 0 : valueOf[left];
        }
    }

    private int take(int context) {
        int place = state & TOTAL - 1;
        int token = tokenAt[context][place];
        state = frequency[context][token] * (state >>> TOTAL_BITS) + place - start[context][token];
        refill();
        return token;
    }

    private int takeLarge(int bits) {
        int value = 1 << bits | state & (1 << bits) - 1;
        state >>>= bits;
        refill();
        return value;
    }

    private void refill() {
        if (state < STATE_MIN) state = state << 16 | word();
    }

    private int word() {
        int value = laneNext + 1 < bytes.length ? u16(laneNext) : 0;
        laneNext += 2;
        return value;
    }

    private static int predict(int l, int u, int ul) {
        int low = Math.min(l, u);
        return Math.max(low, Math.min(l + u - low, l + u - ul));
    }

    private static int order(int a, int b) {
        return 1 + Integer.compare(a, b);
    }

    private static int aboveClass(int ul, int u, int ur, boolean holeU, boolean holeUr) {
        int holes = (holeU ? 1 : 0) + (holeUr ? 2 : 0);
        return 4 * (holes != 0 ? 8 + holes : 3 * order(ul, u) + order(u, ur));
    }
}
